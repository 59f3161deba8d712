#include "engine/data/health/wrong_rows.hpp"

#include <algorithm>
#include <map>

#include "engine/data/health/position_steps.hpp"
#include "engine/data/health/sentinels.hpp"
#include "engine/data/health/standstill.hpp"

namespace torquescope {
namespace {

bool is_zero_row(Examination const& exam, std::size_t row) {
  return std::all_of(exam.channels.begin(), exam.channels.end(), [&](auto const& one) {
    double const value = one.second.values[row];
    return one.first == "time" || value == 0.0 || std::isnan(value);
  });
}

// a logger that starts before the first message, or a table that was allocated longer than it was filled
void leave_out_zeros_at_the_ends(Examination& exam) {
  constexpr std::size_t fewest = 3;  // a recording may begin at zero
  // a joint that waits at zero for a command that is zero looks the same, but for its torque
  if (!exam.has("torque")) return;
  auto const leave_out = [&](std::size_t from, std::size_t until) {
    std::vector<std::size_t> rows;
    for (std::size_t i = from; i < until; ++i) rows.push_back(i);
    if (rows.size() < fewest) return;
    for (auto& [name, channel] : exam.channels)
      if (name != "time")
        for (std::size_t row : rows) channel.values[row] = missing;
    exam.add(FindingKind::single_wrong_rows, Grade::warning, Repair::left_out, "position", rows, 0.0);
  };
  std::size_t const n = exam.rows();
  std::size_t head = 0, tail = n;
  while (head < n && is_zero_row(exam, head)) ++head;
  while (tail > head && is_zero_row(exam, tail - 1)) --tail;
  leave_out(0, head);
  leave_out(tail, n);
}

// Rows in turns from two sources: two rows on, the signal is nearer than one row on. Of a smooth signal it is twice as
// far, of noise as far; and the turns are a good part of the whole range
bool is_interleaved(std::vector<double> const& values) {
  constexpr double nearer = 0.2, part_of_range = 0.02;
  double one_on = 0.0, two_on = 0.0, least = values.front(), most = least;
  std::size_t counted = 0;
  for (std::size_t i = 2; i < values.size(); ++i) {
    if (!std::isfinite(values[i]) || !std::isfinite(values[i - 1]) || !std::isfinite(values[i - 2])) continue;
    one_on += std::fabs(values[i] - values[i - 1]);
    two_on += std::fabs(values[i] - values[i - 2]);
    least = std::min(least, values[i]);
    most = std::max(most, values[i]);
    ++counted;
  }
  if (counted == 0 || !(most > least)) return false;
  return two_on < nearer * one_on && one_on > part_of_range * (most - least) * static_cast<double>(counted);
}

// the value that most of the rows hold
double common_value(std::vector<double> const& values, std::vector<std::size_t> const& rows) {
  std::map<double, int> times;
  for (std::size_t row : rows) ++times[values[row]];
  return std::max_element(times.begin(), times.end(), [](auto const& a, auto const& b) { return a.second < b.second; })
      ->first;
}

void fill_excursions(Examination& exam, Roughness const& roughness) {
  constexpr double many = 0.1;  // of the rows: no longer single ones
  auto& position = exam.values("position");
  std::vector<std::size_t> rows;
  for (auto const& one : excursions_of(position, roughness))
    for (std::size_t k = 0; k < one.count; ++k) rows.push_back(one.first + k);
  if (rows.empty()) return;
  double const value = common_value(position, rows);
  if (static_cast<double>(rows.size()) > many * static_cast<double>(position.size())) {
    exam.add(FindingKind::rows_interleaved, Grade::fault, Repair::none, "position", rows);
    return;
  }
  // a row of zeros is a message that was never filled: none of its channels says anything
  for (std::size_t row : rows) {
    bool const torque_is_none = !exam.has("torque") || exam.values("torque")[row] == 0.0;
    bool const all = is_zero_row(exam, row) || (position[row] == 0.0 && torque_is_none);
    for (auto const* name : {"torque", "velocity", "acceleration", "reference", "simulated_torque"})
      if (all && exam.has(name) && exam.values(name)[row] == 0.0) exam.values(name)[row] = missing;
    position[row] = missing;
  }
  exam.add(FindingKind::single_wrong_rows, Grade::warning, Repair::filled, "position", rows, value);
}

void report_jumps(Examination& exam, Roughness const& roughness) {
  std::vector<std::size_t> rows;
  double largest = 0.0;
  for (auto const& jump : jumps_of(exam.values("position"), exam.time_s, roughness)) {
    rows.push_back(jump.row);
    if (std::fabs(jump.size) > std::fabs(largest)) largest = jump.size;
  }
  if (!rows.empty()) exam.add(FindingKind::position_jumps, Grade::fault, Repair::none, "position", rows, largest);
}

}  // namespace

void examine_position_rows(Examination& exam) {
  leave_out_zeros_at_the_ends(exam);
  if (covers_few_steps(exam.values("position"))) return;
  if (is_interleaved(exam.values("position"))) {
    exam.add(FindingKind::rows_interleaved, Grade::fault, Repair::none, "position", {});
    return;
  }
  auto const roughness = roughness_of(exam.values("position"));
  fill_excursions(exam, roughness);
  examine_values_inside(exam, "position");
  report_jumps(exam, roughness_of(exam.values("position")));
}

void examine_torque_rows(Examination& exam) {
  // a spike is at most three rows, and no other row reaches a quarter of it: in a recording of many impacts some do
  constexpr double beyond_all_others = 4.0, most_rows = 0.002;
  constexpr std::size_t longest = 3;
  if (!exam.has("torque")) return;
  auto& torque = exam.values("torque");
  auto const known = known_rows(torque);
  std::vector<double> sizes;
  for (std::size_t row : known) sizes.push_back(std::fabs(torque[row]));
  if (sizes.size() < 20) return;
  std::vector<double> sorted = sizes;
  std::sort(sorted.begin(), sorted.end());
  auto const spikes_at_most = static_cast<std::size_t>(most_rows * static_cast<double>(sorted.size())) + longest;
  double limit = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k <= std::min(spikes_at_most, sorted.size() - 1); ++k) {
    double const smaller = sorted[sorted.size() - k - 1];
    if (smaller > 0.0 && sorted[sorted.size() - k] > beyond_all_others * smaller) limit = sorted[sorted.size() - k];
  }
  std::vector<std::size_t> rows;
  double largest = 0.0;
  std::size_t run = 0, longest_run = 0;
  for (std::size_t k = 0; k < known.size(); ++k) {
    run = sizes[k] >= limit ? run + 1 : 0;
    longest_run = std::max(longest_run, run);
    if (run > 0) rows.push_back(known[k]);
  }
  if (rows.empty() || longest_run > longest) return;
  for (std::size_t row : rows) {
    if (std::fabs(torque[row]) > std::fabs(largest)) largest = torque[row];
    torque[row] = missing;
  }
  exam.add(FindingKind::torque_spikes, Grade::warning, Repair::filled, "torque", rows, largest);
}

}  // namespace torquescope
