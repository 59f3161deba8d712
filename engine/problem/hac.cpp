#include "engine/problem/hac.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

// sum_t s_t s_{t-lag}' within each recording
Eigen::MatrixXd lagged_product(Eigen::MatrixXd const& scores, std::vector<Eigen::Index> const& first_row,
                               Eigen::Index lag) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(scores.cols(), scores.cols());
  for (std::size_t k = 0; k + 1 < first_row.size(); ++k) {
    auto const count = first_row[k + 1] - first_row[k] - lag;
    if (count > 0)
      sum.noalias() +=
          scores.middleRows(first_row[k] + lag, count).transpose() * scores.middleRows(first_row[k], count);
  }
  return sum;
}

struct Autoregression {
  double rho = 0.0;
  double innovation_variance = 0.0;
};

Autoregression fit_autoregression(Eigen::MatrixXd const& scores, std::vector<Eigen::Index> const& first_row,
                                  Eigen::Index column) {
  double product = 0.0, energy = 0.0;
  for (std::size_t k = 0; k + 1 < first_row.size(); ++k) {
    auto const rows = first_row[k + 1] - first_row[k];
    if (rows < 2) continue;
    auto const s = scores.col(column).segment(first_row[k], rows);
    product += s.head(rows - 1).dot(s.tail(rows - 1));
    energy += s.head(rows - 1).squaredNorm();
  }
  Autoregression fit;
  if (energy <= 0.0) return fit;
  // a root at one would ask for an infinite bandwidth (Andrews, Monahan 1992 cut at 0.97 too)
  fit.rho = std::clamp(product / energy, -0.97, 0.97);
  fit.innovation_variance = (1.0 - fit.rho * fit.rho) * energy;
  return fit;
}

}  // namespace

std::int64_t andrews_lags(Eigen::MatrixXd const& scores, std::vector<Eigen::Index> const& first_row) {
  // columns have different units: each counts relative to its own long-run variance
  double numerator = 0.0, denominator = 0.0;
  for (Eigen::Index column = 0; column < scores.cols(); ++column) {
    auto const fit = fit_autoregression(scores, first_row, column);
    if (fit.innovation_variance <= 0.0) continue;
    double const rest = 1.0 - fit.rho;
    numerator += 4.0 * fit.rho * fit.rho / (rest * rest * (1.0 + fit.rho) * (1.0 + fit.rho));
    denominator += 1.0;
  }
  if (denominator == 0.0) return 0;
  auto const n = static_cast<double>(scores.rows());
  double const bandwidth = 1.1447 * std::cbrt(numerator / denominator * n);
  // the kernel is zero at the bandwidth itself
  auto const lags = static_cast<std::int64_t>(std::ceil(bandwidth)) - 1;
  return std::clamp<std::int64_t>(lags, 0, scores.rows() / 2);
}

Eigen::MatrixXd newey_west_covariance(Eigen::MatrixXd const& scores, Eigen::MatrixXd const& bread,
                                      std::vector<Eigen::Index> const& first_row, std::int64_t lags) {
  TORQUESCOPE_EXPECT(lags >= 0 && scores.rows() > scores.cols());
  TORQUESCOPE_EXPECT(first_row.front() == 0 && first_row.back() == scores.rows());
  Eigen::MatrixXd meat = lagged_product(scores, first_row, 0);
  for (std::int64_t lag = 1; lag <= lags; ++lag) {
    double const weight = 1.0 - static_cast<double>(lag) / static_cast<double>(lags + 1);
    Eigen::MatrixXd const product = lagged_product(scores, first_row, lag);
    meat += weight * (product + product.transpose());
  }
  auto const n = static_cast<double>(scores.rows());
  return n / (n - static_cast<double>(scores.cols())) * bread * meat * bread;
}

double critical_value(std::int64_t lags, Eigen::Index n_rows) {
  constexpr double normal = 1.959963984540054;
  if (lags == 0) return normal;
  double const b = static_cast<double>(lags + 1) / static_cast<double>(n_rows);
  return normal + b * (2.9694 + b * (0.4160 - 0.5324 * b));
}

}  // namespace torquescope
