#include "engine/diagnose/arms/tip_touch.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "engine/base/dense_solvers.hpp"
#include "engine/fit/problem/least_squares.hpp"
#include "engine/robot/tip_wrench.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr Index fewest_windows = 20;  // fewer are no distribution

// rows of one recording by instant; 0 where a joint has none
struct TouchRows {
  std::size_t file = 0;
  double begin_s = 0.0, rate_hz = 0.0;
  MatrixXd left{}, has{};             // [instants][N] in noises; 1 or 0
  std::vector<MatrixXd> of_wrench{};  // [N] instants x 6
  Index instants() const { return left.rows(); }
  double time(Index instant) const { return begin_s + static_cast<double>(instant) / rate_hz; }
};

// Friction that the model lacks looks like a touch where two joints are slow, or carry much, together: what any effect
// of low speeds or of the load explains of each joint's residual is taken away
VectorXd beside_slow_friction(RegressionData const& rows, VectorXd left, VectorXd const& weights,
                              TipTouchNumbers const& numbers) {
  auto const effects = std::ssize(numbers.slow);
  for (std::size_t joint = 0; joint < rows.arm->joints(); ++joint) {
    std::vector<Index> own;
    double greatest = 0.0;
    for (std::size_t block = 0; block < rows.recordings(); ++block)
      for (Index i = rows.first_row[block]; rows.arm->joint[block] == joint && i < rows.first_row[block + 1]; ++i) {
        own.push_back(i);
        greatest = std::max(greatest, std::abs(rows.dq[i]));
      }
    if (std::ssize(own) <= effects + 1 || greatest <= 0.0) continue;
    VectorXd const speed = rows.dq(own), residual = left(own), weight = weights(own);
    MatrixXd columns(speed.size(), effects + 1);
    columns.col(effects) = (rows.tau(own) - residual).array().abs() * speed.array().sign();
    for (Index k = 0; k < effects; ++k)
      columns.col(k) =
          speed.array().sign() * (-speed.array().abs() / (numbers.slow[static_cast<std::size_t>(k)] * greatest)).exp();
    MatrixXd const weighted = weight.asDiagonal() * columns;
    VectorXd const sizes =
        solve_semidefinite(MatrixXd(weighted.transpose() * columns), VectorXd(weighted.transpose() * residual));
    left(own) -= columns * sizes;
  }
  return left;
}

// what a fit to the rows of weight 1 leaves of all
VectorXd left_of_fit(RegressionData const& rows, VectorXd const& weights, TipTouchNumbers const& numbers) {
  return beside_slow_friction(rows, rows.tau - rows.phi * solve_weighted(rows, weights), weights, numbers);
}

double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  auto const middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// sums over the instants before each
struct Sums {
  std::vector<Matrix6> square{};
  std::vector<Vector6> along{};
};

// [instants][N] of a recording, and where all joints are known
struct Positions {
  MatrixXd q{};
  std::vector<bool> known{};
};

Positions positions_of(RegressionData const& rows, RegressionData const& others, std::size_t file) {
  auto const& first = rows.arm->first_instant;
  Index const n = first[file + 1] - first[file], joints = rows.arm->scale.size();
  Positions made{MatrixXd::Zero(n, joints), std::vector<bool>(static_cast<std::size_t>(n))};
  Eigen::VectorXi count = Eigen::VectorXi::Zero(n);
  for (auto const* of : {&rows, &others})
    for (std::size_t block = 0; of->arm && block < of->recordings(); ++block)
      for (Index i = of->first_row[block]; i < of->first_row[block + 1]; ++i) {
        Index const at = of->arm->instant[static_cast<std::size_t>(i)] - first[file];
        if (at < 0 || at >= n) break;
        made.q(at, static_cast<Index>(of->arm->joint[block])) = of->q[i];
        ++count[at];
      }
  for (Index at = 0; at < n; ++at) made.known[static_cast<std::size_t>(at)] = count[at] == joints;
  return made;
}

// rows of a recording, each joint by its usual residual: what a touch leaves is not usual
TouchRows rows_of_file(RegressionData const& rows, VectorXd const& left, SerialChain const& chain,
                       Positions const& positions, std::size_t file) {
  constexpr double normal_median = 0.6745;
  auto const& arm = *rows.arm;
  Index const joints = chain.size(), first = arm.first_instant[file], n = positions.q.rows();
  TouchRows made;
  made.file = file;
  made.rate_hz = rows.kept_rate_hz;
  made.left = made.has = MatrixXd::Zero(n, joints);
  made.of_wrench.assign(static_cast<std::size_t>(joints), MatrixXd::Zero(n, 6));
  for (int k = 0; k < 6; ++k) {
    MatrixXd wrench = MatrixXd::Zero(n, 6);
    wrench.col(k).setOnes();
    MatrixXd const torques = torques_of_wrench(chain, positions.q, wrench, WrenchFrame::base);
    for (Index j = 0; j < joints; ++j) made.of_wrench[static_cast<std::size_t>(j)].col(k) = torques.col(j);
  }
  for (std::size_t block = 0; block < rows.recordings(); ++block) {
    Index const from = rows.first_row[block], to = rows.first_row[block + 1];
    if (from == to || arm.instant[static_cast<std::size_t>(from)] < first ||
        arm.instant[static_cast<std::size_t>(from)] >= arm.first_instant[file + 1])
      continue;
    auto const joint = arm.joint[block];
    auto const j = static_cast<Index>(joint);
    std::vector<double> sizes;
    for (Index i = from; i < to; ++i) sizes.push_back(std::abs(left[i]));
    double const usual = std::max(median_of(sizes) / normal_median, 1e-300);
    for (Index i = from; i < to; ++i) {
      Index const at = arm.instant[static_cast<std::size_t>(i)] - first;
      if (!positions.known[static_cast<std::size_t>(at)]) continue;
      made.left(at, j) = left[i] / usual;
      made.has(at, j) = 1.0;
    }
    made.begin_s =
        rows.time_s[from] - static_cast<double>(arm.instant[static_cast<std::size_t>(from)] - first) / made.rate_hz;
    made.of_wrench[joint] = made.has.col(j).asDiagonal() * made.of_wrench[joint] / (usual * arm.scale[j]);
  }
  return made;
}

Sums sums_of(TouchRows const& rows) {
  Index const n = rows.instants();
  Sums sums;
  sums.square.assign(static_cast<std::size_t>(n) + 1, Matrix6::Zero());
  sums.along.assign(static_cast<std::size_t>(n) + 1, Vector6::Zero());
  for (Index i = 0; i < n; ++i) {
    auto const at = static_cast<std::size_t>(i);
    Matrix6 square = sums.square[at];
    Vector6 along = sums.along[at];
    for (std::size_t j = 0; j < rows.of_wrench.size(); ++j) {
      Vector6 const row = rows.of_wrench[j].row(i).transpose();
      square.noalias() += row * row.transpose();
      along += row * rows.left(i, static_cast<Index>(j));
    }
    sums.square[at + 1] = square;
    sums.along[at + 1] = along;
  }
  return sums;
}

// wrench of least energy left; directions that no joint feels stay nearly 0
Vector6 wrench_of(Matrix6 const& square, Vector6 const& along) {
  constexpr double ridge = 1e-6, not_felt = 1e-12;  // of the direction that is felt most
  double const least = not_felt * square.diagonal().maxCoeff();
  Vector6 const scale =
      (square.diagonal().array() > least).select(square.diagonal().array().sqrt().inverse(), 0.0).matrix();
  Matrix6 const scaled = Matrix6(scale.asDiagonal() * square * scale.asDiagonal()) + ridge * Matrix6::Identity();
  return scale.asDiagonal() * Vector6(scaled.ldlt().solve(Vector6(scale.asDiagonal() * along)));
}

double energy_in(Sums const& sums, Index from, Index length) {
  auto const a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(from + length);
  Vector6 const along = sums.along[b] - sums.along[a];
  return along.dot(wrench_of(sums.square[b] - sums.square[a], along));
}

struct Window {
  Index from = 0, length = 0;
  double energy = 0.0;
  Index until() const { return from + length; }
};

std::vector<Index> lengths_of(TouchRows const& rows, TipTouchNumbers const& numbers) {
  std::vector<Index> lengths;
  for (double seconds = numbers.shortest_s; seconds <= numbers.longest_s; seconds *= numbers.longer) {
    auto const length = std::max<Index>(2, std::lround(seconds * rows.rate_hz));
    if ((lengths.empty() || length > lengths.back()) && length * fewest_windows <= rows.instants())
      lengths.push_back(length);
  }
  return lengths;
}

// how far its energy is above that of others of its length
Window most_unusual(Sums const& sums, TouchRows const& rows, std::vector<Index> const& lengths) {
  Window best;
  double most = 0.0;
  for (Index const length : lengths) {
    std::vector<double> energies;
    Index const count = rows.instants() - length + 1;
    for (Index from = 0; from < count; ++from) energies.push_back(energy_in(sums, from, length));
    double const usual = median_of(energies);
    auto const largest = std::max_element(energies.begin(), energies.end());
    double const unusual = *largest - usual;
    if (unusual <= most) continue;
    most = unusual;
    best = {largest - energies.begin(), length, *largest};
  }
  return best;
}

// begin and end to the instant
Window sharpened(Sums const& sums, Window const& around, TouchRows const& rows, TipTouchNumbers const& numbers) {
  Window best = around;
  auto const longest = std::lround(numbers.longest_s * rows.rate_hz);
  for (Index from = std::max<Index>(0, around.from - around.length); from < around.until(); ++from)
    for (Index until = from + 2; until <= std::min(rows.instants(), around.until() + around.length); ++until) {
      if (until - from > longest) break;
      double const energy = energy_in(sums, from, until - from);
      if (energy > best.energy) best = {from, until - from, energy};
    }
  return best;
}

double largest_elsewhere(Sums const& sums, TouchRows const& rows, Window const& found, TipTouchNumbers const& numbers) {
  auto const margin = std::lround(numbers.margin_s * rows.rate_hz);
  double largest = 0.0;
  for (Index from = 0; from + found.length <= rows.instants(); ++from) {
    if (from < found.until() + margin && from + found.length > found.from - margin) continue;
    largest = std::max(largest, energy_in(sums, from, found.length));
  }
  return largest;
}

VectorXd weights_without(RegressionData const& rows, TouchRows const& of, Window const& window,
                         TipTouchNumbers const& numbers) {
  Index const margin = std::lround(numbers.margin_s * of.rate_hz), first = rows.arm->first_instant[of.file];
  VectorXd weights = VectorXd::Ones(rows.rows());
  for (Index i = 0; i < rows.rows(); ++i) {
    Index const at = rows.arm->instant[static_cast<std::size_t>(i)] - first;
    if (at >= window.from - margin && at < window.until() + margin) weights[i] = 0.0;
  }
  return weights;
}

std::optional<TipTouch> touch_at(TouchRows const& rows, Sums const& sums, Window const& found,
                                 TipTouchNumbers const& numbers) {
  auto const a = static_cast<std::size_t>(found.from), b = static_cast<std::size_t>(found.until());
  Matrix6 const square = sums.square[b] - sums.square[a];
  Vector6 const along = sums.along[b] - sums.along[a];
  double whole = 0.0;
  TipTouch touch{rows.file, rows.time(found.from), rows.time(found.until() - 1), {}, {}};
  for (std::size_t j = 0; j < rows.of_wrench.size(); ++j) {
    auto const column = static_cast<Index>(j);
    double const energy = rows.left.col(column).segment(found.from, found.length).squaredNorm(),
                 count = rows.has.col(column).segment(found.from, found.length).sum();
    whole += energy;
    if (energy >= numbers.stands_out * numbers.stands_out * std::max(count, 1.0)) touch.joints.push_back(j);
  }
  double const elsewhere = largest_elsewhere(sums, rows, found, numbers);
  // the same of a force through the tip's origin
  Matrix6 of_force = Matrix6::Identity();
  of_force.topLeftCorner<3, 3>() = square.topLeftCorner<3, 3>();
  Vector6 along_force = Vector6::Zero();
  along_force.head<3>() = along.head<3>();
  Vector6 const force = wrench_of(of_force, along_force);
  if (found.energy < numbers.elsewhere * elsewhere || found.energy < numbers.explained * whole) return {};
  if (touch.joints.size() < 2 || found.from == 0 || found.until() == rows.instants()) return {};
  if (along_force.dot(force) >= numbers.of_force * found.energy) touch.force = force.head<3>().norm();
  return touch;
}

}  // namespace

std::optional<TipTouch> find_tip_touch(RegressionData const& rows, RegressionData const& others,
                                       SerialChain const& chain, TipTouchNumbers const& numbers) {
  bool const has_motion =
      rows.time_s.size() == rows.rows() && rows.dq.size() == rows.rows() && others.q.size() == others.rows();
  if (!rows.arm || !has_motion || rows.rows() == 0) return {};
  VectorXd const left = left_of_fit(rows, VectorXd::Ones(rows.rows()), numbers);
  for (std::size_t file = 0; file + 1 < rows.arm->first_instant.size(); ++file) {
    Positions const positions = positions_of(rows, others, file);
    TouchRows const first = rows_of_file(rows, left, chain, positions, file);
    auto const lengths = lengths_of(first, numbers);
    if (lengths.empty()) continue;
    Window const rough = most_unusual(sums_of(first), first, lengths);
    // a touch bends the fit, and shows elsewhere as well then
    VectorXd const without = left_of_fit(rows, weights_without(rows, first, rough, numbers), numbers);
    TouchRows const again = rows_of_file(rows, without, chain, positions, file);
    Sums const sums = sums_of(again);
    Window const found = sharpened(sums, most_unusual(sums, again, lengths), again, numbers);
    if (auto touch = touch_at(again, sums, found, numbers)) return touch;
  }
  return {};
}

}  // namespace torquescope
