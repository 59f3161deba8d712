#include "engine/diagnose/arms/whole_arm_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/fit/statistics/bounded_projection.hpp"
#include "engine/fit/statistics/inverse_root.hpp"

namespace torquescope {
namespace {

// of an effect over some rows: with itself, with the basis, with the residual
struct EffectProducts {
  Eigen::MatrixXd own{}, cross{};  // r x r, r x k
  Eigen::VectorXd right{};         // r

  EffectProducts operator-(EffectProducts const& other) const {
    return {own - other.own, cross - other.cross, right - other.right};
  }
  Eigen::MatrixXd root() const { return inverse_root(own - cross * cross.transpose(), own.diagonal()); }
  double gain() const { return (root().transpose() * right).squaredNorm(); }
};

// sums from the first row of a recording to the first row of each of its instants, and to its end
class SumsToInstants {
 public:
  SumsToInstants(WholeArmRows const& rows, EffectPlace const& effect, RowBlock const& of, Eigen::MatrixXd const& basis,
                 Eigen::VectorXd const& residual) {
    auto const instant = [&](Eigen::Index i) { return rows.rows[static_cast<std::size_t>(i)].instant; };
    EffectProducts sum{Eigen::MatrixXd::Zero(effect.count, effect.count),
                       Eigen::MatrixXd::Zero(effect.count, basis.cols()), Eigen::VectorXd::Zero(effect.count)};
    for (Eigen::Index i = of.from; i <= of.to; ++i) {
      if (i == of.from || i == of.to || instant(i) != instant(i - 1)) {
        first_rows_.push_back(i);
        sums_.push_back(sum);
      }
      if (i == of.to) break;
      Eigen::VectorXd const at = rows.effects.row(i).segment(effect.first, effect.count);
      sum.own += at * at.transpose();
      sum.cross += at * basis.row(i);
      sum.right += residual[i] * at;
    }
  }

  std::size_t place_of(Eigen::Index row) const {
    return static_cast<std::size_t>(std::lower_bound(first_rows_.begin(), first_rows_.end(), row) -
                                    first_rows_.begin());
  }
  Eigen::Index first_row(std::size_t place) const { return first_rows_[place]; }
  double gain(std::size_t from, std::size_t to) const { return (sums_[to] - sums_[from]).gain(); }

 private:
  std::vector<Eigen::Index> first_rows_{};
  std::vector<EffectProducts> sums_{};
};

// the best of the places low .. high
template <class Gain>
std::size_t best_of(std::size_t low, std::size_t high, Gain const& gain) {
  std::size_t best = low;
  double most = -1.0;
  for (std::size_t place = low; place <= high; ++place)
    if (double const here = gain(place); here > most) {
      most = here;
      best = place;
    }
  return best;
}

RowBlock rows_of_recording(WholeArmRows const& rows, std::size_t recording) {
  RowBlock all{-1, 0};
  for (ArmStretch const& stretch : rows.stretches) {
    if (stretch.recording != recording) continue;
    if (all.from < 0) all.from = stretch.rows.from;
    all.to = stretch.rows.to;
  }
  return all;
}

// the rows in which it acts, to the instant
RowBlock refined(WholeArmRows const& rows, EffectPlace const& effect, StretchWindow const& found,
                 Eigen::MatrixXd const& basis, Eigen::VectorXd const& residual) {
  auto const& stretches = rows.stretches;
  std::size_t const recording = stretches[found.from].recording;
  RowBlock const whole = rows_of_recording(rows, recording);
  SumsToInstants const sums(rows, effect, whole, basis, residual);
  auto const is_own = [&](std::size_t s) { return s < stretches.size() && stretches[s].recording == recording; };
  auto const start_of = [&](std::size_t s) { return sums.place_of(is_own(s) ? stretches[s].rows.from : whole.to); };
  std::size_t const before = found.from > 0 && is_own(found.from - 1) ? found.from - 1 : found.from;
  std::size_t from = start_of(found.from), to = start_of(found.to);
  constexpr int rounds = 2;
  for (int round = 0; round < rounds; ++round) {
    from = best_of(start_of(before), std::min(start_of(found.from + 1), to - 1),
                   [&](std::size_t place) { return sums.gain(place, to); });
    to = best_of(std::max(start_of(found.to - 1), from + 1), start_of(found.to + 1),
                 [&](std::size_t place) { return sums.gain(from, place); });
  }
  return {sums.first_row(from), sums.first_row(to)};
}

// projector: what parameters stand for after the directions that are not there were left out
std::vector<bool> told_apart(Eigen::MatrixXd const& projector) {
  constexpr double whole = 1.0 - 1e-6;
  std::vector<bool> told;
  for (Eigen::Index i = 0; i < projector.rows(); ++i) told.push_back(projector(i, i) > whole);
  return told;
}

Eigen::MatrixXd cluster_sums(WholeArmRows const& rows, Eigen::MatrixXd const& scores) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(scores.cols(), scores.cols());
  for (ArmStretch const& stretch : rows.stretches) {
    Eigen::VectorXd const one = scores.middleRows(stretch.rows.from, stretch.rows.size()).colwise().sum().transpose();
    sum += one * one.transpose();
  }
  auto const n = static_cast<double>(rows.stretches.size());
  return n / (n - 1.0) * sum;
}

}  // namespace

WholeArmFit fit_whole_arm_effect(WholeArmRows const& rows, ScannedEffect const& found, Eigen::MatrixXd const& basis,
                                 Eigen::VectorXd const& residual) {
  EffectPlace const& effect = rows.places[found.effect];
  WholeArmFit fit;
  RowBlock acting{0, rows.torque.size()};
  if (found.window) {
    acting = refined(rows, effect, *found.window, basis, residual);
    std::size_t const recording = rows.stretches[found.window->from].recording;
    auto const time = [&](Eigen::Index row) { return rows.rows[static_cast<std::size_t>(row)].time_s; };
    RowBlock const whole = rows_of_recording(rows, recording);
    fit.time = ActingTime{recording};
    if (acting.from > whole.from) fit.time->from_s = time(acting.from);
    if (acting.to < whole.to) fit.time->until_s = time(acting.to);
  }
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(rows.torque.size(), effect.count);
  columns.middleRows(acting.from, acting.size()) =
      rows.effects.block(acting.from, effect.first, acting.size(), effect.count);
  Eigen::VectorXd const energy = columns.colwise().squaredNorm();
  columns -= basis * inner_products(basis, columns);
  Eigen::MatrixXd const gram = inner_products(columns, columns), root = inverse_root(gram, energy);
  fit.is_told = told_apart(root * (root.transpose() * gram));
  fit.directions = columns * root;
  Eigen::VectorXd const along = inner_products(fit.directions, residual);
  fit.values = root * along;
  fit.torque = along.squaredNorm();
  Eigen::VectorXd const left = residual - fit.directions * along;
  Eigen::MatrixXd const scatter = cluster_sums(rows, left.asDiagonal() * fit.directions);
  fit.errors = (root * scatter * root.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
  return fit;
}

Eigen::VectorXd left_out_of_stretches(WholeArmRows const& rows, Eigen::MatrixXd const& basis,
                                      Eigen::VectorXd const& signal) {
  auto const folds = folds_of_stretches(rows);
  return left_on_rows(folds, basis, signal, fold_products(folds, basis, basis), fold_products(folds, basis, signal));
}

}  // namespace torquescope
