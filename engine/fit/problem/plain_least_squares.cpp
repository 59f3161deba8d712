#include "engine/fit/problem/plain_least_squares.hpp"

#include <algorithm>
#include <cmath>

namespace torquescope {

LeastSquaresFit plain_least_squares(RegressionData const& data, std::int64_t hac_lags) {
  LeastSquaresFit fit;
  fit.parameters = solve_weighted(data, {});
  Eigen::VectorXd const residual = data.tau - data.phi * fit.parameters;
  auto const freedom = static_cast<double>(std::max<Eigen::Index>(data.rows() - data.parameters(), 1));
  double const variance = residual.squaredNorm() / freedom;
  auto const bread = inverse_information(data, {});
  fit.covariance_naive = variance * bread;
  fit.scale = std::sqrt(variance);
  finish_fit(fit, data, residual, bread, hac_lags);
  return fit;
}

}  // namespace torquescope
