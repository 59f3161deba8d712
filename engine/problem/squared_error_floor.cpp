#include "engine/problem/squared_error_floor.hpp"

#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/problem/least_squares.hpp"
#include "engine/problem/row_reduction.hpp"

namespace torquescope {
namespace {

Eigen::MatrixXd triangular_root(RegressionData const& data) {
  return triangular_factor(data) / std::sqrt(static_cast<double>(data.rows()));
}

}  // namespace

SquaredErrorFloor::SquaredErrorFloor(RegressionData const& data)
    : least_squares_(solve_weighted(data, {})),
      mse_(prediction_metrics(data, least_squares_).mse),
      root_(triangular_root(data)) {}

double SquaredErrorFloor::gap(std::span<double const> candidate) const {
  TORQUESCOPE_EXPECT(candidate.size() == static_cast<std::size_t>(least_squares_.size()));
  Eigen::Map<Eigen::VectorXd const> const x(candidate.data(), static_cast<Eigen::Index>(candidate.size()));
  return (root_.triangularView<Eigen::Upper>() * (x - least_squares_)).squaredNorm();
}

}  // namespace torquescope
