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

// of the last digit that is shown
double step_of(double value, int digits) {
  return value == 0.0 ? 0.0 : std::pow(10.0, std::floor(std::log10(std::abs(value))) - digits + 1);
}

// digits that make the rounding of either end small beside the interval between them
int digits_between(double from, double to) {
  constexpr double small = 0.3;
  constexpr int fewest = 2, most = 6;
  int digits = fewest;
  while (digits < most && std::max(step_of(from, digits), step_of(to, digits)) > small * std::abs(to - from)) ++digits;
  return digits;
}

std::string quantity_with_digits(double value, std::string const& unit, int digits) {
  bool const takes_milli = unit == "s" || unit == "rad" || unit == "m";
  if (takes_milli && value != 0.0 && std::abs(value) < 0.00995) return with_digits(1e3 * value, digits) + " m" + unit;
  return unit.empty() || unit == "1" ? with_digits(value, digits) : with_digits(value, digits) + " " + unit;
}

// the next number of one digit that is not smaller: 0.004975 -> "0.005"
std::string rounded_up(double p) {
  double const step = std::pow(10.0, std::floor(std::log10(p)));
  double const up = std::ceil(p / step * (1.0 - 1e-9)) * step;
  return with_digits(up, 1);
}

}  // namespace

std::string two_digits(double value) { return with_digits(value, 2); }

std::string quantity_text(double value, std::string const& unit) { return quantity_with_digits(value, unit, 2); }

std::string between_text(double from, double to, std::string const& unit) {
  int const digits = digits_between(from, to);
  std::string const first = quantity_with_digits(from, unit, digits), last = quantity_with_digits(to, unit, digits);
  for (std::string const& shared : {" m" + unit, " " + unit})
    if (shared.size() > 1 && first.ends_with(shared) && last.ends_with(shared))
      return fmt::format("between {} and {}", first.substr(0, first.size() - shared.size()), last);
  return fmt::format("between {} and {}", first, last);
}

std::string percent_text(double share) {
  if (!std::isfinite(share)) return "?";
  double const percent = 100.0 * share;
  if (std::abs(percent) < 0.995 && percent != 0.0) return two_digits(percent) + " %";
  return fmt::format("{:.1f} %", percent);
}

std::string share_text(double share) { return std::isfinite(share) ? two_digits(100.0 * share) + " %" : ""; }

std::string p_cell(double p, double least) {
  if (!std::isfinite(p)) return "?";
  bool const below_replicates = p < least * (1.0 + 1e-9);
  if (below_replicates || !(p > 0.0)) {
    double const bound = std::max({p, least, 1e-6});
    return "<" + rounded_up(bound);
  }
  return two_digits(std::min(p, 1.0));
}

std::string p_text(double p, double least) {
  std::string const cell = p_cell(p, least);
  return cell.starts_with("<") ? "p < " + cell.substr(1) : "p = " + cell;
}

}  // namespace torquescope
