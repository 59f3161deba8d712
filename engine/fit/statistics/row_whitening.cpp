#include "engine/fit/statistics/row_whitening.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

constexpr std::size_t longest_lag = 48;
constexpr std::size_t frequencies = 512;  // from 0 to half the row rate

// visit(first, end) for every unbroken stretch
template <typename Visit>
void for_each_stretch(std::span<Eigen::Index const> kept_rows, Visit const& visit) {
  std::size_t first = 0;
  for (std::size_t k = 1; k <= kept_rows.size(); ++k) {
    if (k < kept_rows.size() && kept_rows[k] == kept_rows[k - 1] + 1) continue;
    visit(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(k));
    first = k;
  }
}

// mean product of rows `lag` apart in one stretch; as far as there are pairs enough
std::vector<double> covariance_of(Eigen::MatrixXd const& noise, std::span<Eigen::Index const> kept_rows) {
  constexpr Eigen::Index fewest_pairs = 100;
  std::vector<double> covariance;
  for (std::size_t lag = 0; lag <= longest_lag; ++lag) {
    double sum = 0.0;
    Eigen::Index pairs = 0;
    for_each_stretch(kept_rows, [&](Eigen::Index first, Eigen::Index end) {
      Eigen::Index const n = end - first - static_cast<Eigen::Index>(lag);
      if (n <= 0) return;
      sum += noise.middleRows(first, n).cwiseProduct(noise.middleRows(end - n, n)).sum();
      pairs += n;
    });
    if (pairs < fewest_pairs) break;
    covariance.push_back(sum / static_cast<double>(pairs * noise.cols()));
  }
  return covariance;
}

// Parzen's: its spectrum is nowhere negative, so what it makes of a covariance is one
double lag_window(double share) {
  double const rest = 1.0 - share;
  return share <= 0.5 ? 1.0 - 6.0 * share * share * rest : 2.0 * rest * rest * rest;
}

std::vector<double> spectrum_of(std::vector<double> const& covariance) {
  std::vector<double> density(frequencies + 1);
  for (std::size_t j = 0; j <= frequencies; ++j) {
    double sum = covariance[0];
    for (std::size_t lag = 1; lag < covariance.size(); ++lag)
      sum += 2.0 * lag_window(static_cast<double>(lag) / static_cast<double>(covariance.size())) * covariance[lag] *
             std::cos(std::numbers::pi * static_cast<double>(lag * j % (2 * frequencies)) / frequencies);
    density[j] = sum;
  }
  return density;
}

// the same in reverse, by the trapezoid rule
std::vector<double> covariance_from(std::vector<double> const& density, std::size_t lags) {
  std::vector<double> covariance(lags);
  for (std::size_t lag = 0; lag < lags; ++lag) {
    double sum = 0.5 * (density.front() + density.back() * (lag % 2 == 0 ? 1.0 : -1.0));
    for (std::size_t j = 1; j < frequencies; ++j)
      sum += density[j] * std::cos(std::numbers::pi * static_cast<double>(lag * j % (2 * frequencies)) / frequencies);
    covariance[lag] = sum / frequencies;
  }
  return covariance;
}

}  // namespace

RowWhitening::RowWhitening(std::span<double const> covariance, double quietest) {
  TORQUESCOPE_EXPECT(!covariance.empty() && covariance[0] > 0.0 && quietest > 0.0);
  noise_std_ = std::sqrt(quietest);
  double variance = covariance[0];
  std::vector<std::vector<double>> pasts;  // of every order below
  std::vector<double> gains;
  gain_ = std::sqrt(quietest / variance);
  for (std::size_t m = 1; m < covariance.size(); ++m) {
    double product = covariance[m];
    for (std::size_t i = 1; i < m; ++i) product -= past_[i - 1] * covariance[m - i];
    double const reflection = product / variance;
    double const left = variance * (1.0 - reflection * reflection);
    if (!(left > 0.0)) break;  // rounding: as far as the past tells anything
    std::vector<double> past(m);
    for (std::size_t i = 1; i < m; ++i) past[i - 1] = past_[i - 1] - reflection * past_[m - i - 1];
    past[m - 1] = reflection;
    variance = left;
    pasts.push_back(std::exchange(past_, std::move(past)));
    gains.push_back(std::exchange(gain_, std::sqrt(quietest / variance)));
  }
  begin_ = {pasts, gains};
}

void RowWhitening::apply(Eigen::Ref<Eigen::MatrixXd> signals, std::span<Eigen::Index const> kept_rows) const {
  TORQUESCOPE_EXPECT(static_cast<std::size_t>(signals.rows()) == kept_rows.size());
  if (is_identity()) return;
  auto const order = static_cast<Eigen::Index>(past_.size());
  for_each_stretch(kept_rows, [&](Eigen::Index first, Eigen::Index end) {
    Eigen::Index const full = std::min(end, first + order);  // from here on a row has all its past
    for (Eigen::Index column = 0; column < signals.cols(); ++column) {
      double* const x = &signals.coeffRef(0, column);
      // the later rows first, for what stands before a row is still wanted as it was
      kernels::take_prediction_errors(past_.data(), past_.size(), gain_, x + full,
                                      static_cast<std::size_t>(end - full));
      begin_.take(x + first, static_cast<std::size_t>(full - first));
    }
  });
}

RowWhitening whitening_of(Eigen::MatrixXd const& noise, std::span<Eigen::Index const> kept_rows, double cutoff) {
  std::vector<double> covariance = covariance_of(noise, kept_rows);
  if (covariance.empty() || !(covariance[0] > 0.0)) return {};
  std::vector<double> density = spectrum_of(covariance);
  auto const last = std::clamp<std::size_t>(static_cast<std::size_t>(2.0 * cutoff * frequencies), 1, frequencies);
  double const quietest = *std::min_element(density.begin(), density.begin() + static_cast<std::ptrdiff_t>(last));
  // pairs of rows are another few at every lag, so a density may come out below 0
  double const least = std::max(quietest, 1e-9 * covariance[0]);
  for (double& one : density) one = std::max(one, least);
  return {covariance_from(density, covariance.size()), least};
}

}  // namespace torquescope
