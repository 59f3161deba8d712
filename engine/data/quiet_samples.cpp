#include "engine/data/quiet_samples.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "engine/data/encoder_step.hpp"
#include "engine/data/filter_checks.hpp"

namespace torquescope {
namespace {

constexpr double below_half_of_rate = 0.4;
constexpr double noise_span = 4.0;      // of white noise, in standard deviations
constexpr double quiet_periods = 0.25;  // of the motion's cut-off, to either side

// Standard deviation of white noise, by fourth differences: what the motion bends is gone from them
double noise_of(Eigen::VectorXd const& q) {
  constexpr double of_differences = 8.366600265340756, median_of_normal = 0.6744897501960817;  // sqrt(70)
  if (q.size() < 5) return 0.0;
  std::vector<double> sizes;
  for (Eigen::Index k = 2; k + 2 < q.size(); ++k)
    sizes.push_back(std::abs(q[k - 2] - 4.0 * q[k - 1] + 6.0 * q[k] - 4.0 * q[k + 1] + q[k + 2]));
  auto const middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle / (of_differences * median_of_normal);
}

// largest minus smallest position within `reach` samples to either side
Eigen::VectorXd moving_range(Eigen::VectorXd const& q, Eigen::Index reach) {
  Eigen::Index const n = q.size();
  Eigen::VectorXd range(n);
  std::deque<Eigen::Index> high, low;
  Eigen::Index next = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    for (; next < std::min(n, k + reach + 1); ++next) {
      while (!high.empty() && q[high.back()] <= q[next]) high.pop_back();
      while (!low.empty() && q[low.back()] >= q[next]) low.pop_back();
      high.push_back(next);
      low.push_back(next);
    }
    while (high.front() < k - reach) high.pop_front();
    while (low.front() < k - reach) low.pop_front();
    range[k] = q[high.front()] - q[low.front()];
  }
  return range;
}

}  // namespace

std::vector<char> quiet_samples(Recording const& recording, FilterOptions const& filter, double resolution) {
  // of a position that is not filtered, the torque's
  double const band_hz = filter.cutoff_hz > 0.0 ? filter.cutoff_hz : parallel_cutoff_of(filter);
  double const cutoff_hz = band_hz > 0.0 ? band_hz : below_half_of_rate * recording.rate_hz;
  auto const reach = static_cast<Eigen::Index>(std::ceil(quiet_periods / cutoff_hz * recording.rate_hz));
  Eigen::VectorXd const& q = recording.position;
  Eigen::VectorXd const range = moving_range(q, reach);
  double const within = resolution * (1.0 + 1e-6);
  std::vector<char> quiet(static_cast<std::size_t>(q.size()), 0);
  Eigen::Index marked = 0;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    if (range[k] > within) continue;
    Eigen::Index const end = std::min(q.size(), k + reach + 1);
    for (Eigen::Index i = std::max(marked, k - reach); i < end; ++i) quiet[static_cast<std::size_t>(i)] = 1;
    marked = end;
  }
  return quiet;
}

double position_resolution(Recording const& recording) {
  double const step = encoder_step(recording);
  return step > 0.0 ? step : noise_span * noise_of(recording.position);
}

}  // namespace torquescope
