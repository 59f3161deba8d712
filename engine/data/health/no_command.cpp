#include "engine/data/health/no_command.hpp"

#include <limits>
#include <optional>

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

// the value that stands for "no command": far beyond all others and there again and again
std::optional<double> stop_code_of(std::vector<double> const& values) {
  constexpr double far_beyond = 20.0;      // ranges of all others
  constexpr std::size_t fewest_held = 10;  // fewer are wrong rows
  for (bool const is_above : {true, false}) {
    double extreme = is_above ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
    for (double value : values)
      if (std::isfinite(value)) extreme = is_above ? std::max(extreme, value) : std::min(extreme, value);
    std::vector<double> others;
    std::size_t held = 0;
    for (double value : values) {
      if (value == extreme)
        ++held;
      else
        others.push_back(value);
    }
    double const range = range_of(others);
    if (known_rows(others).empty()) return {};  // a constant: examine_constant_reference()
    double nearest = std::numeric_limits<double>::infinity();
    for (double value : others)
      if (std::isfinite(value)) nearest = std::min(nearest, std::fabs(value - extreme));
    if (held >= fewest_held && range > 0.0 && nearest > far_beyond * range) return extreme;
  }
  return {};
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

void take_out_stop_codes(Examination& exam) {
  constexpr double mostly = 0.5;
  if (!exam.has("reference")) return;
  auto& values = exam.values("reference");
  if (known_rows(values).empty()) {
    exam.add(FindingKind::reference_constant, Grade::warning, Repair::channel_unused, "reference", {}, missing);
    exam.channels.erase("reference");
    return;
  }
  auto const code = stop_code_of(values);
  if (!code) return;
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < values.size(); ++row)
    if (values[row] == *code) rows.push_back(row);
  std::size_t const known = known_rows(values).size();
  if (static_cast<double>(rows.size()) < mostly * static_cast<double>(known)) {
    for (std::size_t row : rows) values[row] = missing;
    exam.add(FindingKind::reference_constant, Grade::warning, Repair::left_out, "reference", rows, *code);
    return;
  }
  bool const is_everywhere = rows.size() == known;
  exam.add(FindingKind::reference_constant, Grade::warning, Repair::channel_unused, "reference",
           is_everywhere ? std::vector<std::size_t>() : rows, *code);
  exam.channels.erase("reference");
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
