#include "engine/data/column_look.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/dense_solvers.hpp"
#include "engine/base/median.hpp"

namespace torquescope {
namespace {

constexpr std::size_t most_columns_looked_at = 32;

using Eigen::ArrayXd;
using Eigen::Index;

ArrayXd filled(std::vector<double> const& values) {
  ArrayXd whole(static_cast<Index>(values.size()));
  double last = 0.0;
  for (auto const value : values)
    if (std::isfinite(value)) {
      last = value;
      break;
    }
  for (std::size_t k = 0; k < values.size(); ++k)
    whole[static_cast<Index>(k)] = last = std::isfinite(values[k]) ? values[k] : last;
  return whole;
}

double correlation(ArrayXd const& a, ArrayXd const& b) {
  ArrayXd const x = a - a.mean(), y = b - b.mean();
  double const size = std::sqrt(x.square().sum() * y.square().sum());
  return size > 0 ? (x * y).sum() / size : 0.0;
}

// rows to either side over which a slope is taken: a twentieth of the time between passes of the mean
Index half_window(ArrayXd const& signal) {
  ArrayXd const x = signal - signal.mean();
  Index passes = 1;
  for (Index k = 1; k < x.size(); ++k) passes += (x[k] > 0) != (x[k - 1] > 0);
  constexpr Index of_a_pass = 20;
  return std::max<Index>(1, x.size() / passes / of_a_pass);
}

ArrayXd slope(ArrayXd const& signal, Index half) {
  Index const n = signal.size();
  ArrayXd found = ArrayXd::Zero(n);
  for (Index k = half; k + half < n; ++k)
    found[k] = (signal[k + half] - signal[k - half]) / static_cast<double>(2 * half);
  return found;
}

// rows of noise differ from their neighbours as from any others: 1; a smooth signal: near 0
double roughness(ArrayXd const& signal) {
  Index const n = signal.size();
  ArrayXd const bend = signal.segment(0, n - 2) - 2 * signal.segment(1, n - 2) + signal.segment(2, n - 2);
  double const variance = (signal - signal.mean()).square().mean();
  constexpr double of_white = 6.0;
  return variance > 0 ? std::sqrt(bend.square().mean() / of_white / variance) : 0.0;
}

struct Motion3 {
  std::string column;
  ArrayXd first, second;  // slope and its slope
  Index half = 1;
  double rough = 0.0;
};

double explained(ArrayXd const& signal, Motion3 const& motion) {
  Index const from = 2 * motion.half, n = signal.size() - 2 * from;
  if (n < 8) return 0.0;
  Eigen::MatrixXd columns(n, 4);
  columns << motion.second.segment(from, n).matrix(), motion.first.segment(from, n).matrix(),
      motion.first.segment(from, n).sign().matrix(), Eigen::VectorXd::Ones(n);
  Eigen::VectorXd const y = signal.segment(from, n).matrix();
  for (Index c = 0; c < 3; ++c) {
    double const size = columns.col(c).norm();
    if (size > 0) columns.col(c) /= size;
  }
  double const variance = (y.array() - y.mean()).square().sum();
  Eigen::VectorXd const rest = y - columns * solve_pivoted(columns, y);
  return variance > 0 ? 1 - rest.squaredNorm() / variance : 0.0;
}

// what one column shows beside no other
ColumnLook own_look(std::string const& name, std::vector<double> const& values) {
  ColumnLook look{.column = name};
  ArrayXd const signal = filled(values);
  look.least = signal.minCoeff();
  look.most = signal.maxCoeff();
  std::vector<double> steps;
  std::size_t backwards = 0, others = 0;
  for (Index k = 1; k < signal.size(); ++k) {
    if (signal[k] != signal[k - 1]) steps.push_back(std::fabs(signal[k] - signal[k - 1]));
    backwards += signal[k] < signal[k - 1];
    others += signal[k] != look.least && signal[k] != look.most;
  }
  if (steps.empty()) {
    look.look = Look::constant;
    return look;
  }
  look.step = upper_median(std::move(steps));
  if (backwards == 0)
    look.look = Look::clock;
  else if (others == 0)
    look.look = Look::two_values;
  return look;
}

// The most alike first: a motion about one frequency is as like the bend of its own, and a speed is as smooth as a
// position. What another column is the derivative of stays a position
void mark_derivatives(std::vector<ArrayXd> const& signals, std::vector<Motion3> const& smooth,
                      std::vector<ColumnLook>& looks) {
  // a filtered speed is as like; a torque that is mostly friction reaches 0.92
  constexpr double is_slope = 0.97;
  struct Pair {
    double likeness;
    std::size_t derivative;
    std::string of;
  };
  std::vector<Pair> pairs;
  for (std::size_t c = 0; c < looks.size(); ++c) {
    if (looks[c].look != Look::like_none && looks[c].look != Look::position) continue;
    for (auto const& motion : smooth)
      if (double const likeness = correlation(signals[c], motion.first);
          motion.column != looks[c].column && std::fabs(likeness) > is_slope)
        pairs.push_back({likeness, c, motion.column});
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](Pair const& a, Pair const& b) { return std::fabs(a.likeness) > std::fabs(b.likeness); });
  std::vector<std::string> positions;
  for (auto const& pair : pairs) {
    auto& look = looks[pair.derivative];
    auto const base = std::find_if(looks.begin(), looks.end(), [&](auto const& one) { return one.column == pair.of; });
    bool const is_taken = std::find(positions.begin(), positions.end(), look.column) != positions.end();
    if (is_taken || look.look == Look::derivative || base->look == Look::derivative) continue;
    look.look = Look::derivative;
    look.of = pair.of;
    look.likeness = pair.likeness;
    positions.push_back(pair.of);
  }
}

}  // namespace

std::vector<ColumnLook> column_looks(RawTable const& table) {
  constexpr double is_smooth = 0.05, is_torque = 0.5;
  // a torque without noise is smooth but for its friction at reversals: the motion has to explain more of it
  constexpr double is_smooth_torque = 0.8, rougher = 2.0;
  constexpr Index fewest_rows = 64;
  std::vector<ColumnLook> looks;
  std::vector<ArrayXd> signals;
  for (std::size_t c = 0; c < std::min(table.names.size(), most_columns_looked_at); ++c) {
    looks.push_back(own_look(table.names[c], table.columns[c]));
    signals.push_back(filled(table.columns[c]));
  }
  if (signals.empty() || signals.front().size() < fewest_rows) return looks;
  std::vector<Motion3> smooth;
  for (std::size_t c = 0; c < looks.size(); ++c) {
    if (looks[c].look != Look::like_none || roughness(signals[c]) > is_smooth) continue;
    Index const half = half_window(signals[c]);
    ArrayXd const first = slope(signals[c], half);
    smooth.push_back({looks[c].column, first, slope(first, half), half, roughness(signals[c])});
    looks[c].look = Look::position;
  }
  mark_derivatives(signals, smooth, looks);
  auto const is_position = [&](std::string const& column) {
    return std::any_of(looks.begin(), looks.end(),
                       [&](auto const& one) { return one.column == column && one.look == Look::position; });
  };
  for (std::size_t c = 0; c < looks.size(); ++c) {
    auto& look = looks[c];
    if (look.look != Look::like_none && look.look != Look::position) continue;
    double const rough = roughness(signals[c]), enough = look.look == Look::position ? is_smooth_torque : is_torque;
    for (auto const& motion : smooth) {
      if (!is_position(motion.column) || rough < rougher * motion.rough) continue;
      double const share = explained(signals[c], motion);
      if (share > std::max(enough, look.likeness))
        look = {look.column, Look::torque, look.least, look.most, look.step, motion.column, share};
    }
  }
  return looks;
}

}  // namespace torquescope
