#include "engine/fit/statistics/profiled_interval.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

constexpr double chi_squared = 1.96 * 1.96;
constexpr int most_doublings = 40;
constexpr int halvings = 6;

// the end of what the fit does not notice on the way from `value` to `bound`
double furthest(double value, double bound, double first_step, std::function<bool(double)> const& is_noticed) {
  double const direction = bound < value ? -1.0 : 1.0;
  double const room = std::abs(bound - value);
  double inside = 0.0, outside = std::min(first_step, room);
  for (int i = 0; i < most_doublings && !is_noticed(value + direction * outside); ++i) {
    if (outside >= room) return bound;
    inside = outside;
    outside = std::min(2.0 * outside, room);
  }
  for (int i = 0; i < halvings; ++i) {
    double const middle = 0.5 * (inside + outside);
    (is_noticed(value + direction * middle) ? outside : inside) = middle;
  }
  return value + direction * outside;
}

}  // namespace

std::pair<double, double> profiled_interval(ProfiledParameter const& parameter, double row_noise, double hidden,
                                            std::function<double(double)> const& gain) {
  TORQUESCOPE_EXPECT(parameter.first_step > 0.0 && row_noise >= 0.0 && hidden >= 0.0);
  auto const [value, lower, upper, first_step] = parameter;
  double const least = gain(value) - chi_squared * row_noise - hidden;
  auto const is_noticed = [&](double at) { return gain(at) < least; };
  return {furthest(value, std::min(lower, value), first_step, is_noticed),
          furthest(value, std::max(upper, value), first_step, is_noticed)};
}

}  // namespace torquescope
