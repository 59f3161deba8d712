#include "engine/diagnose/arms/torque_delay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/dense_solvers.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double lag_step_s = 0.005, longest_lag_s = 0.060;
constexpr Index blocks_of_recording = 8;  // fitted and held out in turn

std::vector<Index> lags_at(double rate_hz) {
  Index const step = std::max<Index>(1, std::lround(lag_step_s * rate_hz)),
              each_way = std::max<Index>(2, std::lround(longest_lag_s * rate_hz / static_cast<double>(step)));
  std::vector<Index> lags;
  for (Index k = -each_way; k <= each_way; ++k) lags.push_back(k * step);
  return lags;
}

// a signal `lag` samples later; its ends last
VectorXd taken_later(VectorXd const& signal, Index lag) {
  VectorXd later(signal.size());
  for (Index i = 0; i < signal.size(); ++i) later[i] = signal[std::clamp<Index>(i + lag, 0, signal.size() - 1)];
  return later;
}

// which torque of each joint is taken: the place of its lag
using Places = std::vector<std::size_t>;

class DelaySearchOfArm {
 public:
  DelaySearchOfArm(LaggedGrams const& grams, TorqueDelayNumbers const& numbers)
      : grams_(grams),
        numbers_(numbers),
        joints_(grams.of_side.size()),
        places_(joints_, grams.lags.size() / 2),
        is_late_(joints_, false) {
    for (auto const& sides : grams.of_side) whole_.push_back(sides[0] + sides[1]);
    torque_ = VectorXd::Ones(static_cast<Index>(joints_));
    for (std::size_t j = 0; j < joints_; ++j) torque_[at(j)] = std::max(torque_energy(whole_[j], places_[j]), 1e-300);
    weigh();
  }

  std::vector<TorqueDelay> run() {
    VectorXd const before = held_out(places_);
    while (auto const late = next_late()) {
      is_late_[late->first] = true;
      places_[late->first] = late->second;
      weigh();
      for (std::size_t j = 0; j < joints_; ++j)  // those found before may have made up for this one
        if (is_late_[j]) places_[j] = best_place(j);
    }
    VectorXd const after = held_out(places_);
    std::vector<TorqueDelay> found;
    for (std::size_t j = 0; j < joints_; ++j) {
      double const lag = is_late_[j] ? finest_lag(j) : 0.0;
      if (std::abs(lag) < numbers_.least_samples) continue;
      found.push_back({j, lag / grams_.rate_hz, std::sqrt(before[at(j)] / torque_[at(j)]),
                       std::sqrt(after[at(j)] / torque_[at(j)])});
    }
    return found;
  }

 private:
  static Index at(std::size_t joint) { return static_cast<Index>(joint); }

  Index columns_of(std::size_t j) const { return std::ssize(grams_.parameters[j]); }

  double torque_energy(MatrixXd const& gram, std::size_t place) const {
    Index const t = gram.rows() - std::ssize(grams_.lags) + at(place);
    return gram(t, t);
  }

  // of a side, or of all: what parameters leave of a joint's torque at a place
  double left_of(MatrixXd const& gram, std::size_t j, VectorXd const& parameters, std::size_t place) const {
    Index const own = columns_of(j), t = own + at(place);
    VectorXd const x = parameters(grams_.parameters[j]);
    double const crossed = x.dot(gram.col(t).head(own));
    return std::max(gram(t, t) - 2.0 * crossed + x.dot(gram.topLeftCorner(own, own) * x), 0.0);
  }

  template <typename GramOf>
  VectorXd fit(Places const& places, GramOf const& gram_of) const {
    MatrixXd information = MatrixXd::Zero(grams_.unknowns, grams_.unknowns);
    VectorXd right = VectorXd::Zero(grams_.unknowns);
    for (std::size_t j = 0; j < joints_; ++j) {
      auto const& own = grams_.parameters[j];
      MatrixXd const& gram = gram_of(j);
      Index const n = columns_of(j);
      information(own, own) += gram.topLeftCorner(n, n) / variance_[at(j)];
      right(own) += gram.col(n + at(places[j])).head(n) / variance_[at(j)];
    }
    VectorXd const scale = information.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    MatrixXd const scaled = scale.asDiagonal() * information * scale.asDiagonal();
    return scale.asDiagonal() * solve_semidefinite(scaled, VectorXd(scale.asDiagonal() * right));
  }

  VectorXd fit_of_all(Places const& places) const {
    return fit(places, [&](std::size_t j) -> MatrixXd const& { return whole_[j]; });
  }

  // each joint by what a fit leaves of it, in a few passes
  void weigh() {
    constexpr int passes = 4;
    constexpr double least = 1e-6;  // of the torque's energy: what fits exactly must not outweigh everything
    variance_ = torque_;
    for (int pass = 0; pass < passes; ++pass) {
      VectorXd const parameters = fit_of_all(places_);
      VectorXd next(variance_.size());
      for (std::size_t j = 0; j < joints_; ++j)
        next[at(j)] = std::max(left_of(whole_[j], j, parameters, places_[j]), least * torque_[at(j)]);
      variance_ = next;
    }
  }

  // [N] energy left on blocks that the fit has not seen
  VectorXd held_out(Places const& places) const {
    VectorXd left = VectorXd::Zero(at(joints_));
    for (std::size_t side = 0; side < 2; ++side) {
      VectorXd const parameters =
          fit(places, [&](std::size_t j) -> MatrixXd const& { return grams_.of_side[j][1 - side]; });
      for (std::size_t j = 0; j < joints_; ++j)
        left[at(j)] += left_of(grams_.of_side[j][side], j, parameters, places[j]);
    }
    return left;
  }

  // [N] energy left on the blocks of the fit: of a short recording it is far lower
  VectorXd seen(Places const& places) const {
    VectorXd const parameters = fit_of_all(places);
    VectorXd left(at(joints_));
    for (std::size_t j = 0; j < joints_; ++j) left[at(j)] = left_of(whole_[j], j, parameters, places[j]);
    return left;
  }

  // of all joints, weighed
  double cost(Places const& places) const { return seen(places).cwiseQuotient(variance_).sum(); }

  std::size_t best_place(std::size_t joint) const {
    Places tried = places_;
    std::size_t best = places_[joint];
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t place = 0; place < grams_.lags.size(); ++place) {
      tried[joint] = place;
      double const one = cost(tried);
      if (one >= least) continue;
      least = one;
      best = place;
    }
    return best;
  }

  // At the end of the grid nothing is known: something else than a lag has it fall that far
  bool is_within(std::size_t place) const { return place > 0 && place + 1 < grams_.lags.size(); }

  std::optional<std::pair<std::size_t, std::size_t>> next_late() const {
    VectorXd const before = held_out(places_), own = seen(places_);
    std::optional<std::pair<std::size_t, std::size_t>> best;
    double least = cost(places_);
    for (std::size_t j = 0; j < joints_; ++j) {
      if (is_late_[j]) continue;
      Places tried = places_;
      tried[j] = best_place(j);
      if (grams_.lags[tried[j]] == 0 || !is_within(tried[j])) continue;
      VectorXd const after = held_out(tried);
      bool const mends = after[at(j)] < numbers_.halves * own[at(j)],
                 harms = (after.array() > numbers_.worse * before.array()).any();
      double const one = cost(tried);
      if (!mends || harms || one >= least) continue;
      least = one;
      best = {j, tried[j]};
    }
    return best;
  }

  // samples: the least of a parabola through three places
  double finest_lag(std::size_t joint) const {
    std::size_t const middle = places_[joint];
    if (!is_within(middle)) return static_cast<double>(grams_.lags[middle]);
    double costs[3];
    for (std::size_t k = 0; k < 3; ++k) {
      Places tried = places_;
      tried[joint] = middle + k - 1;
      costs[k] = cost(tried);
    }
    double const bend = costs[0] - 2.0 * costs[1] + costs[2];
    double const aside = bend > 0.0 ? std::clamp(0.5 * (costs[0] - costs[2]) / bend, -1.0, 1.0) : 0.0;
    return static_cast<double>(grams_.lags[middle]) + aside * static_cast<double>(grams_.lags[1] - grams_.lags[0]);
  }

  LaggedGrams const& grams_;
  TorqueDelayNumbers const& numbers_;
  std::size_t joints_;
  Places places_;
  std::vector<bool> is_late_;
  std::vector<MatrixXd> whole_{};
  VectorXd torque_{}, variance_{};  // [N] energies
};

}  // namespace

void LaggedGrams::add(ArmModel const& model, std::vector<Motion> const& motion, RecordedRows const& rows,
                      ParallelFilter const& filter) {
  if (lags.empty()) {
    lags = lags_at(rows.rate_hz);
    rate_hz = rows.rate_hz;
    unknowns = static_cast<Index>(model.size());
    for (std::size_t j = 0; j < model.joints(); ++j) {
      parameters.push_back(model.parameters_of(j));
      Index const size = std::ssize(parameters.back()) + std::ssize(lags);
      of_side.push_back({MatrixXd::Zero(size, size), MatrixXd::Zero(size, size)});
    }
  }
  if (rows.rate_hz != rate_hz) return;
  for (std::size_t j = 0; j < motion.size(); ++j) {
    JointRows const& own = rows.moving[j];
    if (own.torque.size() == 0) continue;
    Index const columns = own.columns.cols();
    MatrixXd both(own.torque.size(), columns + std::ssize(lags));
    both.leftCols(columns) = own.columns;
    // what is known of a payload is not late
    VectorXd const known = filter.apply(motion[j].torque)(own.instant) - own.torque;
    for (std::size_t k = 0; k < lags.size(); ++k)
      both.col(columns + static_cast<Index>(k)) =
          filter.apply(taken_later(motion[j].torque, lags[k]))(own.instant) - known;
    for (Index side = 0; side < 2; ++side) {
      std::vector<Index> of_block;
      for (Index i = 0; i < both.rows(); ++i)
        if (own.instant[static_cast<std::size_t>(i)] * blocks_of_recording / rows.instants % 2 == side)
          of_block.push_back(i);
      MatrixXd const part = both(of_block, Eigen::all);
      of_side[j][static_cast<std::size_t>(side)].noalias() += part.transpose() * part;
    }
  }
}

std::vector<TorqueDelay> find_torque_delays(LaggedGrams const& grams, TorqueDelayNumbers const& numbers) {
  bool const has_rows = std::all_of(grams.of_side.begin(), grams.of_side.end(), [](auto const& sides) {
    return sides[0].diagonal().sum() > 0.0 && sides[1].diagonal().sum() > 0.0;
  });
  if (grams.of_side.empty() || !has_rows) return {};
  return DelaySearchOfArm(grams, numbers).run();
}

}  // namespace torquescope
