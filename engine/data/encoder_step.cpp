#include "engine/data/encoder_step.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/data/signal_facts.hpp"

namespace torquescope {
namespace {

std::vector<double> jumps_behind_held(std::span<double const> values) {
  std::vector<double> jumps;
  for (std::size_t i = 2; i < values.size(); ++i)
    if (values[i - 1] == values[i - 2] && values[i] != values[i - 1])
      jumps.push_back(std::fabs(values[i] - values[i - 1]));
  return jumps;
}

double jump_behind_held(std::span<double const> values) {
  constexpr std::size_t fewest = 8;
  constexpr double most_alike = 0.75, near = 0.5;
  std::vector<double> jumps = jumps_behind_held(values);
  if (jumps.size() < fewest) return 0.0;
  auto const middle = jumps.begin() + static_cast<std::ptrdiff_t>(jumps.size() / 2);
  std::nth_element(jumps.begin(), middle, jumps.end());
  double const median = *middle;
  auto const alike =
      std::count_if(jumps.begin(), jumps.end(), [&](double jump) { return std::fabs(jump - median) <= near * median; });
  return static_cast<double>(alike) >= most_alike * static_cast<double>(jumps.size()) ? median : 0.0;
}

}  // namespace

double shown_step(std::span<double const> positions) {
  double const step = quantisation_step(positions);
  return step > 0.0 ? step : jump_behind_held(positions);
}

double encoder_step(Recording const& recording) {
  if (recording.rows.encoder_step > 0.0) return recording.rows.encoder_step;
  return shown_step({recording.position.data(), static_cast<std::size_t>(recording.position.size())});
}

}  // namespace torquescope
