#include "engine/data/resample.hpp"

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

// slope at times[at] of the parabola through samples m-1, m, m+1
double parabola_slope(std::span<double const> times, std::span<double const> values, std::size_t m, std::size_t at) {
  double const left = times[m] - times[m - 1], right = times[m + 1] - times[m];
  double const left_slope = (values[m] - values[m - 1]) / left, right_slope = (values[m + 1] - values[m]) / right;
  double const curvature = (right_slope - left_slope) / (left + right);
  return left_slope + curvature * ((times[at] - times[m - 1]) + (times[at] - times[m]));
}

double tangent(std::span<double const> times, std::span<double const> values, std::size_t at) {
  std::size_t const last = times.size() - 1;
  std::size_t const middle = at == 0 ? 1 : (at == last ? last - 1 : at);
  return parabola_slope(times, values, middle, at);
}

}  // namespace

std::vector<double> interpolate(std::span<double const> times, std::span<double const> values,
                                std::span<double const> queries) {
  TORQUESCOPE_EXPECT(times.size() == values.size() && times.size() >= 3);
  std::vector<double> result;
  result.reserve(queries.size());
  std::size_t i = 0;
  for (double query : queries) {
    while (i + 2 < times.size() && times[i + 1] <= query) ++i;
    TORQUESCOPE_EXPECT(query >= times[i] && query <= times[i + 1]);
    double const step = times[i + 1] - times[i];
    double const s = (query - times[i]) / step;
    double const start = tangent(times, values, i) * step, end = tangent(times, values, i + 1) * step;
    double const rise = values[i + 1] - values[i];
    // Hermite cubic, written as corrections to the first value: exact at s = 0
    result.push_back(values[i] + s * (start + s * ((3 * rise - 2 * start - end) + s * (start + end - 2 * rise))));
  }
  return result;
}

}  // namespace torquescope
