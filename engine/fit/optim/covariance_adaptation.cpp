#include "engine/fit/optim/covariance_adaptation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"

namespace torquescope {

namespace {

using Eigen::Index;

constexpr double most_deviation = 1.0, least_deviation = 1e-12, most_condition = 1e14;

// log-linear, of the better half
Eigen::VectorXd recombination_weights(std::size_t n_samples) {
  auto const mu = static_cast<Index>(n_samples / 2);
  Eigen::VectorXd weights(mu);
  for (Index i = 0; i < mu; ++i)
    weights[i] = std::log((static_cast<double>(n_samples) + 1.0) / 2.0) - std::log(static_cast<double>(i) + 1.0);
  return weights / weights.sum();
}

}  // namespace

// the same logarithms go on below 0 for the worse half; what they sum to keeps C positive (tutorial, eq. 49 to 53)
Eigen::VectorXd CovarianceAdaptation::weights_against(std::size_t n_samples) const {
  auto const mu = weights_.size();
  auto const n = static_cast<double>(mean_.size());
  Eigen::VectorXd against(static_cast<Index>(n_samples) - mu);
  for (Index i = 0; i < against.size(); ++i)
    against[i] = std::log((static_cast<double>(n_samples) + 1.0) / 2.0) - std::log(static_cast<double>(mu + i) + 1.0);
  against = against.cwiseMin(0.0);
  double const sum = -against.sum();
  double const mu_eff = 1.0 / weights_.squaredNorm(), mu_eff_against = sum * sum / against.squaredNorm();
  double const most =
      std::min({1.0 + c_1_ / c_mu_, 1.0 + 2.0 * mu_eff_against / (mu_eff + 2.0), (1.0 - c_1_ - c_mu_) / (n * c_mu_)});
  return against * (most / sum);
}

CovarianceAdaptation::CovarianceAdaptation(Eigen::VectorXd mean, double sigma, std::size_t n_samples)
    : weights_(recombination_weights(n_samples)),
      mean_(std::move(mean)),
      sigma_(sigma),
      path_sigma_(Eigen::VectorXd::Zero(mean_.size())),
      path_c_(path_sigma_),
      covariance_(Eigen::MatrixXd::Identity(mean_.size(), mean_.size())) {
  TORQUESCOPE_EXPECT(n_samples >= 4 && mean_.size() >= 1);
  auto const n = static_cast<double>(mean_.size());
  double const mu_eff = 1.0 / weights_.squaredNorm();
  c_sigma_ = (mu_eff + 2.0) / (n + mu_eff + 5.0);
  d_sigma_ = 1.0 + 2.0 * std::max(0.0, std::sqrt((mu_eff - 1.0) / (n + 1.0)) - 1.0) + c_sigma_;
  c_c_ = (4.0 + mu_eff / n) / (n + 4.0 + 2.0 * mu_eff / n);
  c_1_ = 2.0 / ((n + 1.3) * (n + 1.3) + mu_eff);
  c_mu_ = std::min(1.0 - c_1_, 2.0 * (mu_eff - 2.0 + 1.0 / mu_eff) / ((n + 2.0) * (n + 2.0) + mu_eff));
  // expected length of a standard normal vector
  usual_length_ = std::sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));
  worse_weights_ = weights_against(n_samples);
  decompose();
}

Eigen::VectorXd CovarianceAdaptation::sample(Eigen::VectorXd const& z) const {
  return mean_ + sigma_ * (axes_ * lengths_.cwiseProduct(z));
}

Eigen::VectorXd CovarianceAdaptation::deviates_of(Eigen::VectorXd const& place) const {
  return (axes_.transpose() * (place - mean_)).cwiseQuotient(sigma_ * lengths_);
}

void CovarianceAdaptation::learn(Eigen::MatrixXd const& ranked_z, Eigen::MatrixXd const& worse_z) {
  Index const used = std::min(weights_.size(), ranked_z.cols());
  if (used == 0) return;
  Eigen::VectorXd const weights = weights_.head(used) / weights_.head(used).sum();
  double const mu_eff = 1.0 / weights.squaredNorm();
  auto const n = static_cast<double>(mean_.size());
  ++updates_;

  // the mean's step, in units of sigma; the same with every axis of length 1
  Eigen::MatrixXd const steps = axes_ * lengths_.asDiagonal() * ranked_z.leftCols(used);
  Eigen::VectorXd const step = steps * weights;
  Eigen::VectorXd const step_white = axes_ * (ranked_z.leftCols(used) * weights);
  mean_ += sigma_ * step;

  path_sigma_ = (1.0 - c_sigma_) * path_sigma_ + std::sqrt(c_sigma_ * (2.0 - c_sigma_) * mu_eff) * step_white;
  double const length = path_sigma_.norm();
  // no rank-one update while the step size is far too small: the path would only say so again
  double const settled = std::sqrt(1.0 - std::pow(1.0 - c_sigma_, 2.0 * static_cast<double>(updates_)));
  bool const stalled = length / settled >= (1.4 + 2.0 / (n + 1.0)) * usual_length_;
  path_c_ *= 1.0 - c_c_;
  if (!stalled) path_c_ += std::sqrt(c_c_ * (2.0 - c_c_) * mu_eff) * step;
  double const variance_lost = stalled ? c_c_ * (2.0 - c_c_) : 0.0;

  // the worst have the last weights
  Eigen::VectorXd const against = worse_weights_.tail(std::min(worse_z.cols(), worse_weights_.size()));
  covariance_ *= 1.0 - c_1_ - c_mu_ * (1.0 + against.sum()) + c_1_ * variance_lost;
  for (Index i = 0; i < against.size(); ++i) {
    auto const z = worse_z.col(worse_z.cols() - against.size() + i);
    Eigen::VectorXd const away = axes_ * lengths_.cwiseProduct(z);
    // each as long as a usual sample: one far away must not take more than there is
    covariance_ += c_mu_ * against[i] * n / z.squaredNorm() * away * away.transpose();
  }
  covariance_ += c_1_ * path_c_ * path_c_.transpose();
  covariance_ += c_mu_ * steps * weights.asDiagonal() * steps.transpose();
  // rounding differs on both sides of the diagonal
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();

  sigma_ *= std::exp(c_sigma_ / d_sigma_ * (length / usual_length_ - 1.0));
  decompose();
  sigma_ = std::min(sigma_, most_deviation / lengths_.maxCoeff());
}

bool CovarianceAdaptation::is_collapsed() const {
  double const longest = lengths_.maxCoeff(), shortest = lengths_.minCoeff();
  return !(sigma_ * longest > least_deviation) || !(longest * longest < most_condition * shortest * shortest);
}

void CovarianceAdaptation::decompose() {
  auto const found = symmetric_axes(covariance_);
  axes_ = found.vectors;
  lengths_ = found.values.cwiseMax(0.0).cwiseSqrt();
}

std::vector<double> CovarianceAdaptation::numbers() const {
  std::vector<double> all(mean_.begin(), mean_.end());
  all.push_back(sigma_);
  all.push_back(static_cast<double>(updates_));
  all.insert(all.end(), path_sigma_.begin(), path_sigma_.end());
  all.insert(all.end(), path_c_.begin(), path_c_.end());
  all.insert(all.end(), covariance_.data(), covariance_.data() + covariance_.size());
  return all;
}

void CovarianceAdaptation::restore(std::span<double const> numbers) {
  Index const n = mean_.size();
  TORQUESCOPE_EXPECT(numbers.size() == numbers_of(static_cast<std::size_t>(n)));
  double const* from = numbers.data();
  mean_ = Eigen::Map<Eigen::VectorXd const>(from, n);
  sigma_ = from[n];
  updates_ = static_cast<std::int64_t>(from[n + 1]);
  from += n + 2;
  path_sigma_ = Eigen::Map<Eigen::VectorXd const>(from, n);
  path_c_ = Eigen::Map<Eigen::VectorXd const>(from + n, n);
  covariance_ = Eigen::Map<Eigen::MatrixXd const>(from + 2 * n, n, n);
  decompose();
}

}  // namespace torquescope
