#include "engine/diagnose/arms/link_change.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "engine/diagnose/arms/gram_fit.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index scan_blocks = 30;                // of a recording, fitted and held out in turn
constexpr Index first_cut = scan_blocks / 5;     // fewer blocks do not tell the links
constexpr Index fewest_rows = 20 * scan_blocks;  // of a recording
using Grams = std::vector<JointGram>;            // one a joint

enum class WhatChanges { links, frictions };

ArmSamples rows_of(ArmSamples const& all, Index first, Index count) {
  ArmSamples some;
  some.q = all.q.middleRows(first, count);
  some.dq = all.dq.middleRows(first, count);
  some.ddq = all.ddq.middleRows(first, count);
  some.tau = all.tau.middleRows(first, count);
  some.moves = all.moves.middleRows(first, count);
  some.time_s = all.time_s.segment(first, count);
  return some;
}

std::vector<JointSamples> joints_of(ArmSamples const& samples) {
  auto const span_of = [](MatrixXd const& of, Index j) {
    return std::span<double const>(of.col(j).data(), static_cast<std::size_t>(of.rows()));
  };
  std::vector<JointSamples> joints;
  for (Index j = 0; j < samples.q.cols(); ++j)
    joints.push_back({span_of(samples.q, j), span_of(samples.dq, j), span_of(samples.ddq, j), span_of(samples.tau, j),
                      span_of(samples.moves, j)});
  return joints;
}

// the joints before the instant, then those after it
GramUnknowns unknowns_of(ArmRows const& rows, Index n_base, WhatChanges what) {
  GramUnknowns const one = gram_unknowns(rows, n_base);
  GramUnknowns both = one;
  Index const frictions = one.count - n_base;
  for (auto const& places : one.places) {
    auto& others = both.places.emplace_back();
    for (Index const place : places) {
      bool const is_link = place < n_base;
      if (what == WhatChanges::links)
        others.push_back(is_link ? one.count + place : place);
      else
        others.push_back(is_link ? place : place + frictions);
    }
  }
  both.count += what == WhatChanges::links ? n_base : frictions;
  return both;
}

// blocks of this parity, before the cut and after it
Grams halves_of(std::vector<Grams> const& blocks, Index cut, Index parity) {
  std::size_t const joints = blocks.front().size();
  Grams sums(2 * joints);
  for (Index b = 0; b < scan_blocks; ++b)
    for (std::size_t j = 0; j < joints; ++j) {
      JointGram block = blocks[static_cast<std::size_t>(b)][j];
      if (b % 2 != parity) block = {MatrixXd::Zero(block.products.rows(), block.products.cols()), 0};
      add_gram(sums[b < cut ? j : joints + j], block);
    }
  return sums;
}

// all blocks, before the cut and after it
Grams whole_of(std::vector<Grams> const& blocks, Index cut) {
  Grams sums = halves_of(blocks, cut, 0);
  Grams const others = halves_of(blocks, cut, 1);
  for (std::size_t k = 0; k < sums.size(); ++k) add_gram(sums[k], others[k]);
  return sums;
}

// of each joint, before and after the cut together
struct ErrorSums {
  VectorXd left, whole;

  explicit ErrorSums(Index joints) : left(VectorXd::Zero(joints)), whole(VectorXd::Constant(joints, 1e-300)) {}

  void add(Grams const& grams, GramUnknowns const& unknowns, VectorXd const& values) {
    Index const joints = left.size();
    for (Index k = 0; k < 2 * joints; ++k) {
      auto const& gram = grams[static_cast<std::size_t>(k)];
      auto const count = static_cast<double>(gram.count);
      left[k % joints] += count * square_of(gram, direction_of(unknowns, values, k));
      whole[k % joints] += count * torque_square(gram);
    }
  }
  VectorXd errors() const { return (left.array() / whole.array()).sqrt(); }
};

// [N] on held-out blocks
VectorXd errors_of(std::vector<Grams> const& blocks, Index cut, GramUnknowns const& unknowns) {
  ErrorSums sums(static_cast<Index>(blocks.front().size()));
  for (Index parity = 0; parity < 2; ++parity)
    sums.add(halves_of(blocks, cut, 1 - parity), unknowns, fitted(halves_of(blocks, cut, parity), unknowns));
  return sums.errors();
}

// [N] of a fit to all blocks, on these
VectorXd own_errors_of(std::vector<Grams> const& blocks, Index cut, GramUnknowns const& unknowns) {
  ErrorSums sums(static_cast<Index>(blocks.front().size()));
  Grams const whole = whole_of(blocks, cut);
  sums.add(whole, unknowns, fitted(whole, unknowns));
  return sums.errors();
}

double score_of(VectorXd const& errors) { return errors.array().max(SetupFit::floor).log().sum(); }

// the row from which the second set of links is the better one
Index first_of_second(ArmRows const& rows, ArmSamples const& samples, std::vector<Grams> const& blocks, Index cut,
                      GramUnknowns const& unknowns) {
  Grams const sums = whole_of(blocks, cut);
  VectorXd const values = fitted(sums, unknowns);
  auto const channels = joints_of(samples);
  Index const joints = samples.q.cols();
  VectorXd gain = VectorXd::Zero(samples.size());  // of the first set against the second
  for (Index j = 0; j < joints; ++j) {
    MatrixXd const of_joint = rows.rows(channels, j);
    VectorXd const first = of_joint * direction_of(unknowns, values, j),
                   second = of_joint * direction_of(unknowns, values, joints + j);
    auto const& before = sums[static_cast<std::size_t>(j)];
    double const size = std::max({square_of(before, direction_of(unknowns, values, j)),
                                  SetupFit::floor * SetupFit::floor * torque_square(before), 1e-300});
    gain += (second.cwiseAbs2() - first.cwiseAbs2()) / size;
  }
  Index best = 0;
  double sum = 0.0, most = 0.0;
  for (Index k = 0; k < gain.size(); ++k) {
    sum += gain[k];
    if (sum <= most) continue;
    most = sum;
    best = k + 1;
  }
  return std::min(best, gain.size() - 1);
}

struct Found {
  double gain;
  LinkChange change;
};

std::optional<Found> change_in(ArmSamples const& samples, SerialChain const& chain, BaseParameters const& base,
                               SetupNumbers const& numbers) {
  std::vector<FrictionColumns> const friction(static_cast<std::size_t>(samples.q.cols()));
  ArmRows const rows(chain, base, friction);
  std::vector<Grams> blocks;
  Index const n = samples.size();
  for (Index b = 0; b < scan_blocks; ++b) {
    Index const begin = b * n / scan_blocks, end = (b + 1) * n / scan_blocks;
    blocks.push_back(joint_grams(rows, joints_of(rows_of(samples, begin, end - begin)), 1));
  }
  GramUnknowns const links = unknowns_of(rows, base.size(), WhatChanges::links),
                     frictions = unknowns_of(rows, base.size(), WhatChanges::frictions);
  Found best{0.0, {}};
  Index best_cut = 0;
  for (Index cut = first_cut; cut <= scan_blocks - first_cut; ++cut) {
    VectorXd const before = errors_of(blocks, cut, frictions), after = errors_of(blocks, cut, links);
    double const gain = score_of(before) - score_of(after);
    if (gain <= best.gain) continue;
    if (!halves_one(before, own_errors_of(blocks, cut, frictions), after, numbers.least_error, numbers)) continue;
    best = {gain, {0.0, samples.time_s[n - 1], 0, before, after}};
    best_cut = cut;
  }
  if (best_cut == 0) return {};
  best.change.time_s = samples.time_s[first_of_second(rows, samples, blocks, best_cut, links)];
  return best;
}

}  // namespace

std::optional<LinkChange> find_link_change(ArmSamples const& samples, SerialChain const& chain,
                                           SetupNumbers const& numbers) {
  BaseParameters const base(chain, DriveInertias::included);
  std::optional<Found> clearest;
  for (std::size_t k = 0; k < samples.begins.size(); ++k) {
    Index const first = samples.begins[k], end = k + 1 < samples.begins.size() ? samples.begins[k + 1] : samples.size();
    if (end - first < fewest_rows) continue;
    auto found = change_in(rows_of(samples, first, end - first), chain, base, numbers);
    if (!found || (clearest && found->gain <= clearest->gain)) continue;
    found->change.recording = k;
    clearest = std::move(found);
  }
  if (!clearest) return {};
  return clearest->change;
}

}  // namespace torquescope
