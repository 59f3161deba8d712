#include "engine/data/signal_facts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace torquescope {
namespace {

double median_of(std::vector<double>& values) {
  auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// samples in runs of three and more at the given value
std::size_t samples_resting_at(std::span<double const> values, double level) {
  std::size_t resting = 0, run = 0;
  for (double value : values) {
    run = value == level ? run + 1 : 0;
    if (run == 3) resting += 3;
    if (run > 3) ++resting;
  }
  return resting;
}

}  // namespace

double quantisation_step(std::span<double const> values) {
  std::vector<double> steps;
  double range = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    double const step = std::fabs(values[i] - values[i - 1]);
    range = std::max(range, step);
    if (step > 0) steps.push_back(step);
  }
  // printed digits make equal steps differ a little: what is a thousand times smaller than the largest is no step
  std::erase_if(steps, [&](double step) { return step < 1e-9 * range; });
  if (steps.size() < 8) return 0.0;
  double const least = *std::min_element(steps.begin(), steps.end());
  // the smallest step, averaged over all that are about as small
  std::vector<double> single;
  for (double step : steps)
    if (step < 1.5 * least) single.push_back(step);
  double const candidate = median_of(single);
  // a real step is met again and again, and every other difference is a multiple of it
  std::size_t multiples = 0, small = 0;
  for (double step : steps) {
    double const count = step / candidate;
    if (count > 50) continue;  // printed digits blur large multiples
    ++small;
    multiples += std::fabs(count - std::round(count)) < 0.05;
  }
  bool const met_often = single.size() * 200 >= steps.size() && single.size() >= 4;
  return met_often && multiples * 100 >= 98 * small ? candidate : 0.0;
}

double limit_share(std::span<double const> values) {
  if (values.size() < 8) return 0.0;
  std::map<double, std::size_t> count_of_value;
  for (double value : values) ++count_of_value[value];
  if (count_of_value.size() < 4) return 0.0;  // on and off: its levels are not limits
  auto const resting_at = [&](auto level, auto next) {
    // three times as often as its neighbour: a signal that turns round by itself visits both alike
    return level->second > 3 * next->second ? samples_resting_at(values, level->first) : 0;
  };
  auto const low = count_of_value.begin();
  auto const high = std::prev(count_of_value.end());
  std::size_t const resting = resting_at(low, std::next(low)) + resting_at(high, std::prev(high));
  return static_cast<double>(resting) / static_cast<double>(values.size());
}

double white_noise(Eigen::Ref<Eigen::VectorXd const> const& signal) {
  if (signal.size() < 8) return 0.0;
  std::vector<double> bends;
  for (Eigen::Index i = 1; i + 1 < signal.size(); ++i)
    bends.push_back(std::fabs(signal[i - 1] - 2 * signal[i] + signal[i + 1]));
  constexpr double median_of_normal = 0.6744897501960817;         // of |z|
  return median_of(bends) / (median_of_normal * std::sqrt(6.0));  // variance 1 + 4 + 1
}

}  // namespace torquescope
