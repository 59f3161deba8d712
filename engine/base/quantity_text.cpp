#include "engine/base/quantity_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace torquescope {

namespace {

// decimals that show `digits` significant digits of the value, after rounding to them
int decimals_for(double value, int digits) {
  double const size = std::abs(value);
  if (size == 0.0) return 0;
  int const exponent = static_cast<int>(std::floor(std::log10(size)));
  // 0.0996 becomes 0.10: rounding may add a digit in front
  double const step = std::pow(10.0, exponent - digits + 1);
  int const rounded = static_cast<int>(std::floor(std::log10(std::round(size / step) * step * (1.0 + 1e-12))));
  return std::max(0, digits - 1 - rounded);
}

std::string with_digits(double value, int digits) {
  if (!std::isfinite(value)) return "?";
  double const size = std::abs(value);
  if (size != 0.0 && (size < 1e-6 || size >= 1e6)) return fmt::format("{:.{}e}", value, digits - 1);
  if (size >= std::pow(10.0, digits)) {
    // 152 said with two digits is 150
    double const step = std::pow(10.0, std::floor(std::log10(size)) - digits + 1);
    return fmt::format("{:.0f}", std::round(value / step) * step);
  }
  return fmt::format("{:.{}f}", value, decimals_for(value, digits));
}

// the next number of one digit that is not smaller: 0.004975 -> "0.005"
std::string rounded_up(double p) {
  double const step = std::pow(10.0, std::floor(std::log10(p)));
  double const up = std::ceil(p / step * (1.0 - 1e-9)) * step;
  return with_digits(up, 1);
}

}  // namespace

std::string two_digits(double value) { return with_digits(value, 2); }

std::string quantity_text(double value, std::string const& unit) {
  bool const takes_milli = unit == "s" || unit == "rad" || unit == "m";
  if (takes_milli && value != 0.0 && std::abs(value) < 0.00995) return two_digits(1e3 * value) + " m" + unit;
  return unit.empty() || unit == "1" ? two_digits(value) : two_digits(value) + " " + unit;
}

std::string percent_text(double share) {
  if (!std::isfinite(share)) return "?";
  double const percent = 100.0 * share;
  if (std::abs(percent) < 0.995 && percent != 0.0) return two_digits(percent) + " %";
  return fmt::format("{:.1f} %", percent);
}

std::string p_cell(double p, bool is_bound, double least) {
  if (!std::isfinite(p)) return "?";
  bool const below_twins = p < least * (1.0 + 1e-9);
  if (is_bound || below_twins || !(p > 0.0)) {
    double const bound = std::max({p, least, 1e-6});
    return "<" + rounded_up(bound);
  }
  return two_digits(std::min(p, 1.0));
}

std::string p_text(double p, bool is_bound, double least) {
  std::string const cell = p_cell(p, is_bound, least);
  return cell.starts_with("<") ? "p < " + cell.substr(1) : "p = " + cell;
}

}  // namespace torquescope
