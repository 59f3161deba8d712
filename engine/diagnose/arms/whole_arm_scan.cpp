#include "engine/diagnose/arms/whole_arm_scan.hpp"

#include <algorithm>
#include <limits>

#include "engine/base/parallel.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/fit/statistics/bounded_projection.hpp"
#include "engine/fit/statistics/inverse_root.hpp"
#include "engine/fit/statistics/left_out_gains.hpp"
#include "engine/fit/statistics/replicate_null.hpp"

namespace torquescope {
namespace {

// signs that the null draws: a level of a thousandth can be told
constexpr Eigen::Index n_replicates = 999;
constexpr auto folds_count = static_cast<std::size_t>(n_folds);

std::size_t fold_of(std::size_t stretch) { return stretch % folds_count; }

// products of one stretch; k columns of the basis, L of all effects
struct OfStretch {
  Eigen::MatrixXd basis{}, effects{}, effects_basis{};   // k x k, L x L, L x k
  Eigen::VectorXd basis_residual{}, effects_residual{};  // k, L
};

// stretches x (1 + M): the recording first, then replicates
Eigen::MatrixXd signs_of(std::size_t stretches, ScanSetting const& setting) {
  Eigen::MatrixXd signs = Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(stretches), 1 + n_replicates);
  for (Eigen::Index r = 1; r <= n_replicates; ++r) {
    RandomStream random({setting.seed, 0, RandomDomain::resampling}, setting.step, static_cast<std::uint32_t>(r));
    for (Eigen::Index s = 0; s < signs.rows(); ++s) signs(s, r) = random.bits() >> 63 ? 1.0 : -1.0;
  }
  return signs;
}

FoldProducts nothing(Eigen::Index rows, Eigen::Index columns) {
  FoldProducts products;
  products.inside.assign(folds_count, Eigen::MatrixXd::Zero(rows, columns));
  products.whole = Eigen::MatrixXd::Zero(rows, columns);
  return products;
}

void add(FoldProducts& products, std::size_t fold, Eigen::MatrixXd const& part) {
  products.inside[fold] += part;
  products.whole += part;
}

// signals are what is left of one stretch each: all replicates are combinations of them
void add_signal(FoldProducts& products, std::size_t stretch, Eigen::VectorXd const& part) {
  auto const column = static_cast<Eigen::Index>(stretch);
  products.inside[fold_of(stretch)].col(column) += part;
  products.whole.col(column) += part;
}

// no guard: what is inside is what is left out
FoldProducts closed(FoldProducts products) {
  products.left_out = products.inside;
  return products;
}

// left (every product) right
FoldProducts between(Eigen::MatrixXd const& left, FoldProducts products, Eigen::MatrixXd const& right) {
  for (auto* group : {&products.inside, &products.left_out})
    for (auto& one : *group) one = left * one * right;
  products.whole = left * products.whole * right;
  return products;
}

class Scan {
 public:
  Scan(WholeArmRows const& rows, Eigen::MatrixXd const& basis, Eigen::VectorXd const& residual,
       ScanSetting const& setting)
      : rows_(rows), signs_(signs_of(rows.stretches.size(), setting)), stretches_(rows.stretches.size()) {
    parallel_for(stretches_.size(), setting.threads, [&](std::size_t s, int) {
      RowBlock const& block = rows_.stretches[s].rows;
      stretches_[s] = {inner_products(basis, basis, block), inner_products(rows_.effects, rows_.effects, block),
                       inner_products(rows_.effects, basis, block), inner_products(basis, residual, block),
                       inner_products(rows_.effects, residual, block)};
    });
    FoldProducts gram = nothing(basis.cols(), basis.cols()), signals = nothing(basis.cols(), signs_.rows());
    for (std::size_t s = 0; s < stretches_.size(); ++s) {
      add(gram, fold_of(s), stretches_[s].basis);
      add_signal(signals, s, stretches_[s].basis_residual);
    }
    gram_ = closed(std::move(gram));
    signals_ = closed(std::move(signals));
    beside_ = LeftOutGains(gram_, signals_);
  }

  // 1 + M; empty: the basis explains the effect there
  Eigen::RowVectorXd gains(EffectPlace const& effect, StretchWindow const& window) const {
    Eigen::Index const r = effect.count, k = gram_.whole.rows();
    FoldProducts own = nothing(r, r), cross = nothing(r, k), products = nothing(r, signs_.rows());
    for (std::size_t s = window.from; s < window.to; ++s) {
      OfStretch const& one = stretches_[s];
      add(own, fold_of(s), one.effects.block(effect.first, effect.first, r, r));
      add(cross, fold_of(s), one.effects_basis.middleRows(effect.first, r));
      add_signal(products, s, one.effects_residual.segment(effect.first, r));
    }
    Eigen::MatrixXd const in_basis = cross.whole;  // what the basis has of the effect
    Eigen::MatrixXd const root = inverse_root(own.whole - in_basis * in_basis.transpose(), own.whole.diagonal());
    if (root.cols() == 0) return {};
    for (std::size_t f = 0; f < folds_count; ++f) {
      Eigen::MatrixXd const crossed = cross.inside[f] * in_basis.transpose();
      own.inside[f] += in_basis * gram_.inside[f] * in_basis.transpose() - crossed - crossed.transpose();
      cross.inside[f] -= in_basis * gram_.inside[f];
      products.inside[f] -= in_basis * signals_.inside[f];
    }
    own.whole -= in_basis * in_basis.transpose();
    cross.whole.setZero();
    products.whole -= in_basis * signals_.whole;
    Eigen::MatrixXd const across = root.transpose();
    auto const all = [](Eigen::Index n) { return Eigen::MatrixXd::Identity(n, n); };
    Eigen::MatrixXd const form =
        beside_.form(between(across, closed(std::move(cross)), all(k)), between(across, closed(std::move(own)), root),
                     between(across, closed(std::move(products)), all(signs_.rows())));
    return (signs_.array() * (form * signs_).array()).colwise().sum();
  }

 private:
  WholeArmRows const& rows_;
  Eigen::MatrixXd signs_;
  std::vector<OfStretch> stretches_;
  FoldProducts gram_{}, signals_{};
  LeftOutGains beside_{};
};

std::vector<ScannedEffect> candidates_of(WholeArmRows const& rows) {
  std::vector<ScannedEffect> candidates;
  std::size_t const n = rows.stretches.size();
  for (std::size_t effect = 0; effect < rows.places.size(); ++effect) {
    if (!rows.places[effect].effect->is_event()) {
      candidates.push_back({effect});
      continue;
    }
    // of a single recording what acts up to an instant is what acts from there on with the other sign
    bool const is_only_one = rows.stretches.back().recording == 0;
    for (std::size_t from = is_only_one ? 1 : 0; from < n; ++from)
      for (std::size_t to = from + 2; to <= n; ++to) {
        bool const is_one = rows.stretches[from].recording == rows.stretches[to - 1].recording;
        if (is_one) candidates.push_back({effect, StretchWindow{from, to}});
      }
  }
  return candidates;
}

}  // namespace

std::vector<ScannedEffect> scan_whole_arm_effects(WholeArmRows const& rows, Eigen::MatrixXd const& basis,
                                                  Eigen::VectorXd const& residual, ScanSetting const& setting) {
  Scan const scan(rows, basis, residual, setting);
  std::vector<ScannedEffect> candidates = candidates_of(rows);
  // z of every candidate: the recording first, then replicates
  std::vector<std::vector<double>> z(candidates.size());
  parallel_for(candidates.size(), setting.threads, [&](std::size_t i, int) {
    ScannedEffect& one = candidates[i];
    StretchWindow const everywhere{0, rows.stretches.size()};
    Eigen::RowVectorXd const gains = scan.gains(rows.places[one.effect], one.window.value_or(everywhere));
    if (gains.size() == 0) return;
    std::span<double const> const chance(gains.data() + 1, static_cast<std::size_t>(n_replicates));
    one.gain = gains[0];
    one.z = replicate_z(gains[0], chance);
    z[i] = standardised_replicates(chance);
  });
  std::vector<double> largest(static_cast<std::size_t>(n_replicates), -std::numeric_limits<double>::infinity());
  for (auto const& of_one : z)
    for (std::size_t r = 0; r < of_one.size(); ++r) largest[r] = std::max(largest[r], of_one[r]);
  std::vector<ScannedEffect> best;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (z[i].empty()) continue;
    bool const is_new = best.empty() || best.back().effect != candidates[i].effect;
    if (is_new)
      best.push_back(candidates[i]);
    else if (candidates[i].z > best.back().z)
      best.back() = candidates[i];
  }
  for (auto& one : best) one.p = empirical_p(one.z, largest);
  return best;
}

std::vector<Fold> folds_of_stretches(WholeArmRows const& rows) {
  std::vector<Fold> folds(folds_count);
  for (std::size_t s = 0; s < rows.stretches.size(); ++s) folds[fold_of(s)].inside.push_back(rows.stretches[s].rows);
  return folds;
}

}  // namespace torquescope
