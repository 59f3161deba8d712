#include "engine/health/no_command.hpp"

namespace torquescope {
namespace {

bool is_constant(std::vector<double> const& values) {
  auto const known = known_rows(values);
  return !known.empty() &&
         std::all_of(known.begin(), known.end(), [&](std::size_t row) { return values[row] == values[known.front()]; });
}

bool is_far_outside(double value, std::vector<double> const& position) {
  double const range = range_of(position);
  auto const is_away = [&](double q) { return !std::isfinite(q) || std::fabs(q - value) > range; };
  return std::all_of(position.begin(), position.end(), is_away);
}

// the last third of the rows covers most of the range: a motion that came to rest does not
bool goes_on(std::vector<double> const& position) {
  constexpr double most_of_the_range = 0.5;
  auto const last_third = position.begin() + static_cast<std::ptrdiff_t>(position.size() - position.size() / 3);
  return range_of({last_third, position.end()}) > most_of_the_range * range_of(position);
}

void do_not_use(Examination& exam, FindingKind kind, double size) {
  bool const has_torque = exam.has("torque");
  exam.add(kind, Grade::warning, has_torque ? Repair::channel_unused : Repair::none, "reference", {}, size);
  if (has_torque) exam.channels.erase("reference");
}

// share of the rows that move at which reference[i] is position[i + ahead]
double share_equal(std::vector<double> const& q, std::vector<double> const& r, std::ptrdiff_t ahead, double tolerance) {
  auto const n = static_cast<std::ptrdiff_t>(q.size());
  std::size_t moving = 0, equal = 0;
  for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, -ahead); i < std::min(n, n - ahead); ++i) {
    double const now = q[static_cast<std::size_t>(i)], then = q[static_cast<std::size_t>(i + ahead)];
    double const difference = std::fabs(r[static_cast<std::size_t>(i)] - then);
    if (!std::isfinite(difference) || !(std::fabs(then - now) > 0)) continue;
    ++moving;
    equal += difference <= tolerance;
  }
  constexpr std::size_t fewest = 32;
  return moving < fewest ? 0.0 : static_cast<double>(equal) / static_cast<double>(moving);
}

// what a copy of single precision may differ by
double rounding_of(std::vector<double> const& q) {
  constexpr double single_precision = 0x1p-23;
  double largest = 0.0;
  for (double value : q)
    if (std::isfinite(value)) largest = std::max(largest, std::fabs(value));
  return single_precision * largest;
}

}  // namespace

void examine_constant_reference(Examination& exam) {
  if (!exam.has("reference") || !exam.has("torque") || !is_constant(exam.values("reference"))) return;
  double const value = exam.values("reference")[known_rows(exam.values("reference")).front()];
  auto const& position = exam.values("position");
  bool const is_driven_otherwise = exam.has("added_command") || exam.has("external_torque");
  if (is_far_outside(value, position) || (!is_driven_otherwise && goes_on(position)))
    do_not_use(exam, FindingKind::reference_constant, value);
}

void examine_copied_reference(Examination& exam) {
  if (!exam.has("reference")) return;
  auto const& q = exam.values("position");
  // convention: one row in twenty may differ, as where episodes meet. A joint that follows by just a row differs by its
  // acceleration
  constexpr double nearly_all = 0.95;
  constexpr std::ptrdiff_t furthest_ahead = 10, furthest_behind = 3;
  double const tolerance = rounding_of(q);
  for (std::ptrdiff_t ahead = -furthest_behind; ahead <= furthest_ahead; ++ahead) {
    if (ahead == 0 || share_equal(q, exam.values("reference"), ahead, tolerance) < nearly_all) continue;
    return do_not_use(exam, FindingKind::reference_is_position, static_cast<double>(ahead));
  }
}

}  // namespace torquescope
