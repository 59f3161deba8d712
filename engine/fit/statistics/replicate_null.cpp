#include "engine/fit/statistics/replicate_null.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/contract.hpp"

namespace torquescope {

namespace {

// the share of the replicates that the exponential tail is fitted to
constexpr double tail_share = 0.25;

struct Moments {
  double mean = 0.0;
  double variance = 0.0;  // n - 1
};

Moments moments_of(std::span<double const> values) {
  auto const n = static_cast<double>(values.size());
  Moments moments;
  moments.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  for (double value : values) moments.variance += (value - moments.mean) * (value - moments.mean);
  moments.variance /= n - 1.0;
  return moments;
}

double ratio(double difference, double spread) {
  if (spread > 0.0) return difference / spread;
  // replicates that all agree: any difference is infinitely unusual, none is not
  return difference == 0.0 ? 0.0 : std::copysign(HUGE_VAL, difference);
}

}  // namespace

double empirical_p(double data, std::span<double const> replicates) {
  TORQUESCOPE_EXPECT(!replicates.empty());
  auto const above =
      std::count_if(replicates.begin(), replicates.end(), [&](double replicate) { return replicate >= data; });
  return (1.0 + static_cast<double>(above)) / (static_cast<double>(replicates.size()) + 1.0);
}

double replicate_z(double data, std::span<double const> replicates) {
  TORQUESCOPE_EXPECT(replicates.size() >= 2);
  Moments const moments = moments_of(replicates);
  double const one_more = 1.0 + 1.0 / static_cast<double>(replicates.size());
  return ratio(data - moments.mean, std::sqrt(moments.variance * one_more));
}

std::vector<double> standardised_replicates(std::span<double const> replicates) {
  TORQUESCOPE_EXPECT(replicates.size() >= 3);
  auto const n = static_cast<double>(replicates.size());
  Moments const all = moments_of(replicates);
  double const sum_of_squares = all.variance * (n - 1.0);
  std::vector<double> z;
  z.reserve(replicates.size());
  for (double replicate : replicates) {
    double const deviation = replicate - all.mean;
    // mean and variance of the others, without a second pass
    double const difference = deviation * n / (n - 1.0);
    double const variance = std::max(0.0, (sum_of_squares - deviation * deviation * n / (n - 1.0)) / (n - 2.0));
    z.push_back(ratio(difference, std::sqrt(variance * (1.0 + 1.0 / (n - 1.0)))));
  }
  return z;
}

}  // namespace torquescope
