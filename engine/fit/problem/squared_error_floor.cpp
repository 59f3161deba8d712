#include "engine/fit/problem/squared_error_floor.hpp"

#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/fit/problem/least_squares.hpp"
#include "engine/fit/problem/prediction_metrics.hpp"
#include "engine/fit/problem/regressor_health.hpp"

namespace torquescope {
SquaredErrorFloor::SquaredErrorFloor(RegressionData const& data)
    : SquaredErrorFloor(data, too_few_rows(data) ? Reductions{} : reductions_of(data)) {}

SquaredErrorFloor::SquaredErrorFloor(RegressionData const& data, Reductions const& reductions)
    : least_squares_(solve_reduced(data, reductions)),
      mse_(prediction_metrics(data, least_squares_).mse),
      root_(triangular_factor(reductions.raw) / std::sqrt(static_cast<double>(data.rows()))) {}

double SquaredErrorFloor::gap(std::span<double const> candidate) const {
  TORQUESCOPE_EXPECT(candidate.size() == static_cast<std::size_t>(least_squares_.size()));
  Eigen::Map<Eigen::VectorXd const> const x(candidate.data(), static_cast<Eigen::Index>(candidate.size()));
  return (root_.triangularView<Eigen::Upper>() * (x - least_squares_)).squaredNorm();
}

}  // namespace torquescope
