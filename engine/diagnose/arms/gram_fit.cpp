#include "engine/diagnose/arms/gram_fit.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/dense_solvers.hpp"

namespace torquescope {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// noise: of the torque of the joint whose scale is free, its square over all samples. Without it, the noise of that
// torque would draw its own factor to 0
VectorXd solved(std::vector<JointGram> const& grams, GramUnknowns const& unknowns, VectorXd const& weights,
                double noise) {
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
    if (is_scaled)
      square(unknowns.count, unknowns.count) += weight * std::max(products(n, n) - noise, 0.5 * products(n, n));
  }
  // in units of each unknown's own size; a little of each keeps what the motion does not tell small
  constexpr double little = 1e-9;
  VectorXd const size = square.diagonal().cwiseSqrt().cwiseMax(1e-150);
  square = (size.cwiseInverse().asDiagonal() * square * size.cwiseInverse().asDiagonal()).eval();
  square.diagonal().array() += little;
  return solve_semidefinite(square, VectorXd(right.cwiseQuotient(size))).cwiseQuotient(size);
}

}  // namespace

GramUnknowns gram_unknowns(ArmRows const& rows, Index n_base, std::optional<Index> scaled) {
  GramUnknowns unknowns{{}, n_base, scaled};
  for (Index j = 0; j < rows.joints(); ++j) {
    auto& of_joint = unknowns.places.emplace_back();
    for (auto const& column : rows.columns(j))
      of_joint.push_back(column.base == ArmColumn::of_the_joint ? unknowns.count++ : column.base);
  }
  return unknowns;
}

// of one joint: its columns' values, then minus the factor of its torque
VectorXd direction_of(GramUnknowns const& unknowns, VectorXd const& values, Index joint) {
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

void add_gram(JointGram& to, JointGram const& more) {
  if (to.products.size() == 0)
    to = more;
  else {
    to.products += more.products;
    to.count += more.count;
  }
}

VectorXd fitted(std::vector<JointGram> const& grams, GramUnknowns const& unknowns) {
  auto const joints = static_cast<Index>(grams.size());
  VectorXd weights(joints), values;
  for (Index j = 0; j < joints; ++j)
    weights[j] = 1.0 / std::max(torque_square(grams[static_cast<std::size_t>(j)]), 1e-300);
  // the others tell a free factor first; it would begin at 0, where nothing is left to explain
  constexpr double hardly = 1e-4;
  if (unknowns.scaled) weights[*unknowns.scaled] *= hardly;
  double noise = 0.0;
  int const passes = unknowns.scaled ? 8 : 3;  // a factor and its weight tell each other
  for (int pass = 0; pass < passes; ++pass) {
    values = solved(grams, unknowns, weights, noise);
    for (Index j = 0; j < joints; ++j) {
      auto const& gram = grams[static_cast<std::size_t>(j)];
      double const least = GramUnknowns::floor * GramUnknowns::floor * torque_square(gram);
      double const left = square_of(gram, direction_of(unknowns, values, j));
      double const factor = unknowns.scaled == j ? values[unknowns.count] : 1.0;
      weights[j] = 1.0 / std::max({left, factor * factor * least, 1e-300});
      if (unknowns.scaled == j && factor != 0.0) noise = static_cast<double>(gram.count) * left / (factor * factor);
    }
  }
  return values;
}

}  // namespace torquescope
