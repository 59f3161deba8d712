#include "engine/data/butterworth.hpp"

#include <cmath>
#include <numbers>

#include "engine/base/contract.hpp"

namespace torquescope {

std::vector<FilterSection> butterworth_lowpass(int order, double cutoff_hz, double rate_hz) {
  TORQUESCOPE_EXPECT(order >= 1 && cutoff_hz > 0.0 && 2 * cutoff_hz < rate_hz);
  double const k = std::tan(std::numbers::pi * cutoff_hz / rate_hz);
  std::vector<FilterSection> sections;
  for (int pair = 0; pair < order / 2; ++pair) {
    // analog section 1 / (s^2 + damping s + 1) with s = (1 - 1/z) / (k (1 + 1/z))
    double const damping = 2 * std::sin(std::numbers::pi * (2 * pair + 1) / (2.0 * order));
    double const scale = 1 / (1 + damping * k + k * k);
    double const gain = k * k * scale;
    sections.push_back({gain, 2 * gain, gain, 2 * (k * k - 1) * scale, (1 - damping * k + k * k) * scale});
  }
  if (order % 2 == 1) {
    double const gain = k / (1 + k);
    sections.push_back({gain, gain, 0.0, (k - 1) / (1 + k), 0.0});
  }
  return sections;
}

}  // namespace torquescope
