#include "engine/data/health/wrapped_position.hpp"

#include <algorithm>
#include <numbers>
#include <optional>
#include <utility>

#include "engine/base/median.hpp"
#include "engine/data/health/position_steps.hpp"

namespace torquescope {
namespace {

constexpr double share_of_jumps = 0.9;  // of the jumps are wraps; others are wrong rows or zeros set anew

// what remains of a jump when whole moduli are taken off: what the rows around it lead one to expect
bool is_wrap(Jump const& jump, double modulus, double slack) {
  double const left = std::fabs(jump.size) - modulus;
  double const expected = jump.size > 0.0 ? jump.expected : -jump.expected;
  constexpr double of_modulus = 0.02;
  return std::fabs(left - expected) <= std::max(slack, of_modulus * modulus);
}

// of the column's units
std::vector<double> known_moduli(Examination& exam) {
  if (exam.options.wrap > 0.0) return {exam.options.wrap};
  double const turn = 2.0 * std::numbers::pi / std::fabs(exam.options.position_per_unit);
  std::vector<double> moduli{turn, 360.0, 2.0 * std::numbers::pi, 400.0, 3600.0, 36000.0, 360000.0};
  if (are_whole_numbers(exam.values("position")))
    for (int bits = 8; bits <= 32; ++bits) moduli.push_back(std::ldexp(1.0, bits));
  return moduli;
}

// adds or takes off a modulus at each step that is longer than half of it
std::vector<std::size_t> unwrap(std::vector<double>& values, double modulus) {
  std::vector<std::size_t> wraps;
  double added = 0.0, before = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    double const raw = values[i];
    if (std::isfinite(before) && std::fabs(raw - before) > modulus / 2) {
      added += raw > before ? -modulus : modulus;
      wraps.push_back(i);
    }
    values[i] += added;
    before = raw;
  }
  return wraps;
}

double longest_step(std::vector<double> const& values) {
  double longest = 0.0, before = std::numeric_limits<double>::quiet_NaN();
  for (double value : values) {
    if (!std::isfinite(value)) continue;
    if (std::isfinite(before)) longest = std::max(longest, std::fabs(value - before));
    before = value;
  }
  return longest;
}

// The known modulus that explains nearly all jumps, and that the position never exceeds. How far the motion itself
// bends shows only when the wraps are out: where there are many they are most of the bends
std::optional<double> modulus_of(Examination& exam) {
  auto const& position = exam.values("position");
  double const range = range_of(position), longest = longest_step(position);
  for (double modulus : known_moduli(exam)) {
    if (!(longest > modulus / 2)) continue;
    auto unwrapped = position;
    unwrap(unwrapped, modulus);
    auto const roughness = roughness_of(unwrapped);
    double const slack = 10.0 * roughness.bend + 2.0 * roughness.encoder_step;
    if (range > 1.001 * modulus + slack) continue;
    auto const jumps = jumps_of(position, {}, roughness);
    auto const wraps =
        std::count_if(jumps.begin(), jumps.end(), [&](Jump const& j) { return is_wrap(j, modulus, slack); });
    if (wraps > 0 && static_cast<double>(wraps) >= share_of_jumps * static_cast<double>(jumps.size())) return modulus;
  }
  return {};
}

void unwrap_reference(Examination& exam, double modulus) {
  if (!exam.has("reference")) return;
  auto& reference = exam.values("reference");
  auto& position = exam.values("position");
  if (range_of(reference) <= 1.001 * modulus) unwrap(reference, modulus);
  // both count turns from where they began; a whole number of them may lie between
  std::vector<double> apart;
  for (std::size_t i = 0; i < reference.size(); ++i)
    if (std::isfinite(reference[i]) && std::isfinite(position[i])) apart.push_back(position[i] - reference[i]);
  if (apart.empty()) return;
  double const whole = modulus * std::round(upper_median(std::move(apart)) / modulus);
  for (double& value : reference) value += whole;
}

// jumps of one size, both ways or many times, over the whole range
bool has_unknown_modulus(std::vector<Jump> const& jumps, double range) {
  constexpr double same = 0.02, whole_range = 0.95;
  if (jumps.size() < 3) return false;
  double const first = std::fabs(jumps.front().size);
  return std::all_of(jumps.begin(), jumps.end(), [&](Jump const& jump) {
    return std::fabs(std::fabs(jump.size) - first) <= same * first && std::fabs(jump.size) >= whole_range * range;
  });
}

}  // namespace

void unwrap_position(Examination& exam) {
  auto& position = exam.values("position");
  if (auto const modulus = modulus_of(exam); modulus) {
    auto const wraps = unwrap(position, *modulus);
    unwrap_reference(exam, *modulus);
    exam.add(FindingKind::position_wraps, Grade::warning, Repair::corrected, "position", wraps, *modulus);
    return;
  }
  auto const jumps = jumps_of(position, {}, roughness_of(position));
  if (!has_unknown_modulus(jumps, range_of(position))) return;
  double sum = 0.0;
  std::vector<std::size_t> rows;
  for (auto const& jump : jumps) {
    sum += std::fabs(jump.size) + (jump.size > 0.0 ? -jump.expected : jump.expected);
    rows.push_back(jump.row);
  }
  exam.add(FindingKind::wraps_by_unknown, Grade::fault, Repair::none, "position", rows,
           sum / static_cast<double>(jumps.size()));
}

}  // namespace torquescope
