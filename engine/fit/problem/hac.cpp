#include "engine/fit/problem/hac.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

constexpr Eigen::Index rows_at_a_time = 8192;

// visit(scores, fresh) of blocks of a recording's rows; the rows before the last `fresh` ones (at most `before`) belong
// to the block before
template <class Visit>
void for_each_block(RowScores const& rows, std::size_t recording, Eigen::Index before, Visit const& visit) {
  Eigen::Index const begin = rows.first_row[recording], end = rows.first_row[recording + 1];
  for (Eigen::Index first = begin; first < end; first += rows_at_a_time) {
    Eigen::Index const from = std::max(begin, first - before), to = std::min(first + rows_at_a_time, end);
    Eigen::MatrixXd const scores =
        rows.psi.segment(from, to - from).asDiagonal() * rows.phi.middleRows(from, to - from);
    visit(scores, to - first);
  }
}

// sum_t s_t s_{t-lag}' within each recording, for every lag up to `lags`
std::vector<Eigen::MatrixXd> lagged_products(RowScores const& rows, Eigen::Index lags) {
  std::vector<Eigen::MatrixXd> sums(static_cast<std::size_t>(lags) + 1,
                                    Eigen::MatrixXd::Zero(rows.phi.cols(), rows.phi.cols()));
  for (std::size_t k = 0; k + 1 < rows.first_row.size(); ++k)
    for_each_block(rows, k, lags, [&](Eigen::MatrixXd const& scores, Eigen::Index fresh) {
      for (Eigen::Index lag = 0; lag <= lags; ++lag) {
        Eigen::Index const count = std::min(fresh, scores.rows() - lag);
        if (count > 0)
          sums[static_cast<std::size_t>(lag)].noalias() +=
              scores.bottomRows(count).transpose() * scores.middleRows(scores.rows() - lag - count, count);
      }
    });
  return sums;
}

struct Autoregression {
  double rho = 0.0;
  double innovation_variance = 0.0;
};

// of every column
std::vector<Autoregression> fit_autoregressions(RowScores const& rows) {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(rows.phi.cols()), energy = product;
  for (std::size_t k = 0; k + 1 < rows.first_row.size(); ++k)
    for_each_block(rows, k, 1, [&](Eigen::MatrixXd const& scores, Eigen::Index fresh) {
      Eigen::Index const count = std::min(fresh, scores.rows() - 1);
      for (Eigen::Index column = 0; column < scores.cols() && count > 0; ++column) {
        auto const before = scores.col(column).segment(scores.rows() - 1 - count, count);
        product[column] += before.dot(scores.col(column).tail(count));
        energy[column] += before.squaredNorm();
      }
    });
  std::vector<Autoregression> fits(static_cast<std::size_t>(rows.phi.cols()));
  for (Eigen::Index column = 0; column < rows.phi.cols(); ++column) {
    if (energy[column] <= 0.0) continue;
    auto& fit = fits[static_cast<std::size_t>(column)];
    // a root at one would ask for an infinite bandwidth (Andrews, Monahan 1992 cut at 0.97 too)
    fit.rho = std::clamp(product[column] / energy[column], -0.97, 0.97);
    fit.innovation_variance = (1.0 - fit.rho * fit.rho) * energy[column];
  }
  return fits;
}

}  // namespace

std::int64_t andrews_lags(RowScores const& scores) {
  // columns have different units: each counts relative to its own long-run variance
  double numerator = 0.0, denominator = 0.0;
  for (auto const& fit : fit_autoregressions(scores)) {
    if (fit.innovation_variance <= 0.0) continue;
    double const rest = 1.0 - fit.rho;
    numerator += 4.0 * fit.rho * fit.rho / (rest * rest * (1.0 + fit.rho) * (1.0 + fit.rho));
    denominator += 1.0;
  }
  if (denominator == 0.0) return 0;
  auto const n = static_cast<double>(scores.psi.size());
  double const bandwidth = 1.1447 * std::cbrt(numerator / denominator * n);
  // the kernel is zero at the bandwidth itself
  auto const lags = static_cast<std::int64_t>(std::ceil(bandwidth)) - 1;
  return std::clamp<std::int64_t>(lags, 0, scores.psi.size() / 2);
}

Eigen::MatrixXd newey_west_covariance(RowScores const& scores, Eigen::MatrixXd const& bread, std::int64_t lags) {
  TORQUESCOPE_EXPECT(lags >= 0 && scores.psi.size() > scores.phi.cols() && scores.psi.size() == scores.phi.rows());
  TORQUESCOPE_EXPECT(scores.first_row.front() == 0 && scores.first_row.back() == scores.psi.size());
  auto const products = lagged_products(scores, lags);
  Eigen::MatrixXd meat = products[0];
  for (std::int64_t lag = 1; lag <= lags; ++lag) {
    double const weight = 1.0 - static_cast<double>(lag) / static_cast<double>(lags + 1);
    Eigen::MatrixXd const& product = products[static_cast<std::size_t>(lag)];
    meat += weight * (product + product.transpose());
  }
  auto const n = static_cast<double>(scores.psi.size());
  return n / (n - static_cast<double>(scores.phi.cols())) * bread * meat * bread;
}

double critical_value(std::int64_t lags, Eigen::Index n_rows) {
  constexpr double normal = 1.959963984540054;
  if (lags == 0) return normal;
  double const b = static_cast<double>(lags + 1) / static_cast<double>(n_rows);
  return normal + b * (2.9694 + b * (0.4160 - 0.5324 * b));
}

}  // namespace torquescope
