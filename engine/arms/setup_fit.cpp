#include "engine/arms/setup_fit.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/dense_solvers.hpp"
#include "engine/robot/arm_grams.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index blocks = 8;  // of time, fitted and held out in turn

// products of every joint's columns over the even or the odd blocks
std::vector<JointGram> grams_of(ArmRows const& rows, ArmSamples const& samples, Index side) {
  Index const n = samples.size();
  MatrixXd weights = samples.moves;
  for (Index k = 0; k < n; ++k)
    if (k * blocks / n % 2 != side) weights.row(k).setZero();
  auto const span_of = [n](MatrixXd const& of, Index j) {
    return std::span<double const>(of.col(j).data(), static_cast<std::size_t>(n));
  };
  std::vector<JointSamples> joints;
  for (Index j = 0; j < samples.q.cols(); ++j)
    joints.push_back({span_of(samples.q, j), span_of(samples.dq, j), span_of(samples.ddq, j), span_of(samples.tau, j),
                      span_of(weights, j)});
  return joint_grams(rows, joints, 1);
}

// where the columns of a joint stand among all unknowns: base parameters, then each joint's friction
std::vector<std::vector<Index>> places_of(ArmRows const& rows, Index n_base) {
  std::vector<std::vector<Index>> places;
  Index next = n_base;
  for (Index j = 0; j < rows.joints(); ++j) {
    auto& of_joint = places.emplace_back();
    for (auto const& column : rows.columns(j))
      of_joint.push_back(column.base == ArmColumn::of_the_joint ? next++ : column.base);
  }
  return places;
}

struct Unknowns {
  std::vector<std::vector<Index>> places;
  Index count = 0;              // without a scale
  std::optional<Index> scaled;  // the joint whose torque is known up to a factor

  Index size() const { return count + (scaled ? 1 : 0); }
};

// of one joint: its columns' values, then minus the factor of its torque
VectorXd direction_of(Unknowns const& unknowns, VectorXd const& values, Index joint) {
  auto const& places = unknowns.places[static_cast<std::size_t>(joint)];
  auto const n = static_cast<Index>(places.size());
  VectorXd direction(n + 1);
  for (Index k = 0; k < n; ++k) direction[k] = values[places[static_cast<std::size_t>(k)]];
  direction[n] = unknowns.scaled == joint ? -values[unknowns.count] : -1.0;
  return direction;
}

double square_of(JointGram const& gram, VectorXd const& direction) {
  double const sum = direction.dot(gram.products * direction);
  return gram.count > 0 ? std::max(sum, 0.0) / static_cast<double>(gram.count) : 0.0;
}

double torque_square(JointGram const& gram) {
  Index const last = gram.products.rows() - 1;
  return gram.count > 0 ? gram.products(last, last) / static_cast<double>(gram.count) : 0.0;
}

VectorXd solved(std::vector<JointGram> const& grams, Unknowns const& unknowns, VectorXd const& weights) {
  MatrixXd square = MatrixXd::Zero(unknowns.size(), unknowns.size());
  VectorXd right = VectorXd::Zero(unknowns.size());
  for (std::size_t j = 0; j < grams.size(); ++j) {
    auto const& products = grams[j].products;
    auto const& places = unknowns.places[j];
    auto const n = static_cast<Index>(places.size());
    double const weight = weights[static_cast<Index>(j)];
    bool const is_scaled = unknowns.scaled == static_cast<Index>(j);
    for (Index a = 0; a < n; ++a) {
      Index const row = places[static_cast<std::size_t>(a)];
      for (Index b = 0; b < n; ++b) square(row, places[static_cast<std::size_t>(b)]) += weight * products(a, b);
      if (!is_scaled) {
        right[row] += weight * products(a, n);
      } else {
        square(row, unknowns.count) -= weight * products(a, n);
        square(unknowns.count, row) -= weight * products(a, n);
      }
    }
    if (is_scaled) square(unknowns.count, unknowns.count) += weight * products(n, n);
  }
  // in units of each unknown's own size; a little of each keeps what the motion does not tell small
  constexpr double little = 1e-9;
  VectorXd const size = square.diagonal().cwiseSqrt().cwiseMax(1e-150);
  square = (size.cwiseInverse().asDiagonal() * square * size.cwiseInverse().asDiagonal()).eval();
  square.diagonal().array() += little;
  return solve_semidefinite(square, VectorXd(right.cwiseQuotient(size))).cwiseQuotient(size);
}

VectorXd fitted(std::vector<JointGram> const& grams, Unknowns const& unknowns) {
  auto const joints = static_cast<Index>(grams.size());
  VectorXd weights(joints), values;
  for (Index j = 0; j < joints; ++j)
    weights[j] = 1.0 / std::max(torque_square(grams[static_cast<std::size_t>(j)]), 1e-300);
  constexpr int passes = 3;
  for (int pass = 0; pass < passes; ++pass) {
    values = solved(grams, unknowns, weights);
    for (Index j = 0; j < joints; ++j) {
      auto const& gram = grams[static_cast<std::size_t>(j)];
      double const least = SetupFit::floor * SetupFit::floor * torque_square(gram);
      weights[j] = 1.0 / std::max({square_of(gram, direction_of(unknowns, values, j)), least, 1e-300});
    }
  }
  return values;
}

// of one joint with known base parameters: its error, and the factor of its torque that lowers it most
struct FileFit {
  double error, scale;
};

// links: how many of the standard columns are theirs; the drives' stay open
FileFit file_fit(JointGram const& gram, std::vector<ArmColumn> const& columns, BaseParameters const& base,
                 VectorXd const& values, Index links) {
  auto const n = static_cast<Index>(columns.size());
  std::vector<Index> open;
  VectorXd known = VectorXd::Zero(n + 1);
  for (Index k = 0; k < n; ++k) {
    auto const& column = columns[static_cast<std::size_t>(k)];
    bool const is_open = column.base == ArmColumn::of_the_joint ||
                         base.parameters()[static_cast<std::size_t>(column.base)].column >= links;
    if (is_open)
      open.push_back(k);
    else
      known[k] = values[column.base];
  }
  // what the open columns leave of the torque and of what the file predicts
  VectorXd torque = VectorXd::Unit(n + 1, n), predicted = known;
  auto const m = static_cast<Index>(open.size());
  MatrixXd square(m, m), right(m, 2);
  for (Index a = 0; a < m; ++a) {
    Index const row = open[static_cast<std::size_t>(a)];
    for (Index b = 0; b < m; ++b) square(a, b) = gram.products(row, open[static_cast<std::size_t>(b)]);
    right.row(a) << gram.products.row(row).dot(torque), gram.products.row(row).dot(predicted);
  }
  MatrixXd const shares = solve_semidefinite(square, right);
  for (Index a = 0; a < m; ++a) {
    torque[open[static_cast<std::size_t>(a)]] -= shares(a, 0);
    predicted[open[static_cast<std::size_t>(a)]] -= shares(a, 1);
  }
  double const of_torque = square_of(gram, torque), of_file = square_of(gram, predicted);
  double const both = gram.count > 0 ? torque.dot(gram.products * predicted) / static_cast<double>(gram.count) : 0.0;
  double const left = of_torque - 2.0 * both + of_file;
  return {std::sqrt(std::max(left, 0.0) / std::max(torque_square(gram), 1e-300)), of_file / both};
}

void compare_with_file(SetupFit& fit, ArmRows const& rows, BaseParameters const& base, SerialChain const& chain,
                       std::vector<JointGram> const (&sides)[2]) {
  VectorXd const values = base.from_standard(standard_parameters(chain, DriveInertias::included));
  Index const joints = rows.joints();
  fit.file_error.resize(joints);
  fit.file_scale.resize(joints);
  for (Index j = 0; j < joints; ++j) {
    JointGram whole = sides[0][static_cast<std::size_t>(j)];
    whole.products += sides[1][static_cast<std::size_t>(j)].products;
    whole.count += sides[1][static_cast<std::size_t>(j)].count;
    FileFit const of_joint = file_fit(whole, rows.columns(j), base, values, numbers_per_link * chain.size());
    fit.file_error[j] = of_joint.error;
    fit.file_scale[j] = of_joint.scale;
  }
  fit.file_score = fit.file_error.array().max(SetupFit::floor).log().sum();
}

}  // namespace

SetupFit fit_of(ArmSamples const& samples, ArmSetup const& setup, BaseParameters const& base,
                std::optional<Index> free_scale) {
  ArmSamples const taken = taken_as(samples, setup);
  Index const joints = taken.q.cols();
  std::vector<FrictionColumns> const friction(static_cast<std::size_t>(joints));
  ArmRows const rows(setup.chain, base, friction);
  Unknowns unknowns{places_of(rows, base.size()), base.size(), free_scale};
  for (auto const& places : unknowns.places)
    for (Index const place : places) unknowns.count = std::max(unknowns.count, place + 1);
  std::vector<JointGram> const sides[] = {grams_of(rows, taken, 0), grams_of(rows, taken, 1)};
  SetupFit fit;
  VectorXd squares = VectorXd::Zero(joints), of_torque = VectorXd::Zero(joints);
  for (int side = 0; side < 2; ++side) {
    VectorXd const values = fitted(sides[side], unknowns);
    fit.scale = free_scale ? values[unknowns.count] : 1.0;
    fit.parameters = values.head(base.size());
    for (Index j = 0; j < joints; ++j) {
      auto const& held_out = sides[1 - side][static_cast<std::size_t>(j)];
      double const factor = free_scale == j ? fit.scale : 1.0;
      squares[j] += square_of(held_out, direction_of(unknowns, values, j));
      of_torque[j] += factor * factor * torque_square(held_out);
    }
  }
  fit.error = (squares.array() / of_torque.array().max(1e-300)).sqrt();
  fit.score = fit.error.array().max(SetupFit::floor).log().sum();
  if (setup.chain.has_inertias()) compare_with_file(fit, rows, base, setup.chain, sides);
  return fit;
}

}  // namespace torquescope
