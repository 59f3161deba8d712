#include "engine/fit/excite/motion_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"

namespace torquescope {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

std::vector<Index> neither(std::vector<Index> const& one, std::vector<Index> const& other, Index size) {
  std::vector<Index> rest;
  for (Index k = 0; k < size; ++k)
    if (std::count(one.begin(), one.end(), k) + std::count(other.begin(), other.end(), k) == 0) rest.push_back(k);
  return rest;
}

// gram: of columns of length one
double angle_between(MatrixXd const& gram, std::vector<Index> const& one, std::vector<Index> const& other) {
  std::vector<Index> both = one;
  both.insert(both.end(), other.begin(), other.end());
  auto const rest = neither(one, other, gram.rows());
  MatrixXd left = gram(both, both);
  if (!rest.empty()) {
    auto const root = cholesky_of(gram(rest, rest));
    if (!root) return 0.0;
    MatrixXd const share = root->solve_lower(gram(rest, both));
    left -= share.transpose() * share;
  }
  auto const n = static_cast<Index>(one.size()), m = static_cast<Index>(other.size());
  auto const a = cholesky_of(left.topLeftCorner(n, n)), b = cholesky_of(left.bottomRightCorner(m, m));
  if (!a || !b) return 0.0;
  MatrixXd const half = a->solve_lower(left.topRightCorner(n, m));
  MatrixXd const cosines = b->solve_lower(half.transpose());
  return std::acos(std::min(1.0, singular_values(cosines)[0]));
}

}  // namespace

MotionQuality motion_quality(RowModel const& model, MotionSamples const& samples) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(model.size, model.size);
  auto const rows = model.rows(samples);
  TORQUESCOPE_EXPECT(rows.size() == model.own.size());
  for (std::size_t j = 0; j < rows.size(); ++j) {
    double const noise = model.noise[static_cast<Index>(j)];
    gram(model.own[j], model.own[j]) += rows[j].transpose() * rows[j] / (noise * noise);
  }

  // eigenvalues of the Gram of columns of length one are the squared singular values
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Eigen::VectorXd const squares = gram.diagonal();
  if (!(squares.minCoeff() > 0.0) || !squares.allFinite()) return {infinite, -infinite};
  Eigen::VectorXd const scale = squares.cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd const scaled = scale.asDiagonal() * gram * scale.asDiagonal();
  Eigen::VectorXd const values = symmetric_eigenvalues(scaled);
  double const rounding = std::numeric_limits<double>::epsilon() * static_cast<double>(model.size) * values.maxCoeff();
  if (values.minCoeff() <= rounding) return {infinite, -infinite};
  double const logarithms = values.array().log().sum() + squares.array().log().sum();
  return {std::sqrt(values.maxCoeff() / values.minCoeff()), logarithms / static_cast<double>(model.size),
          model.one.empty() ? 0.0 : angle_between(scaled, model.one, model.other)};
}

}  // namespace torquescope
