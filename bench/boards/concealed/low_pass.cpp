#include "concealed/low_pass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace concealed {
namespace {

// bilinear transform of 1 / (s^2 + 2 damping s + 1), warped to the cut-off
void run_section(std::vector<double>& values, double tangent, double damping) {
  double const k = tangent * tangent;
  double const norm = 1.0 / (1.0 + 2.0 * damping * tangent + k);
  double const b0 = k * norm, a1 = 2.0 * (k - 1.0) * norm, a2 = (1.0 - 2.0 * damping * tangent + k) * norm;
  double x1 = values.front(), x2 = x1, y1 = x1, y2 = x1;
  for (double& value : values) {
    double const x0 = value;
    double const y0 = b0 * (x0 + 2.0 * x1 + x2) - a1 * y1 - a2 * y2;
    x2 = x1;
    x1 = x0;
    y2 = y1;
    y1 = y0;
    value = y0;
  }
}

}  // namespace

std::vector<double> low_passed(std::vector<double> values, double cutoff_hz, double rate_hz) {
  if (values.empty()) return values;
  double const tangent = std::tan(std::numbers::pi * cutoff_hz / rate_hz);
  for (int pass = 0; pass < 2; ++pass) {
    for (double angle : {std::numbers::pi / 8.0, 3.0 * std::numbers::pi / 8.0}) {
      run_section(values, tangent, std::cos(angle));
    }
    std::reverse(values.begin(), values.end());
  }
  return values;
}

}  // namespace concealed
