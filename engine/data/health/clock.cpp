#include "engine/data/health/clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "engine/base/order_statistic.hpp"
#include "engine/data/levels.hpp"
#include "engine/data/ros_stamp.hpp"
#include "engine/data/sampling.hpp"
#include "engine/data/unit_of_name.hpp"

namespace torquescope {
namespace {

// not upper_median(): no second copy of some 1e7 stamps
double median_of(std::vector<double> const& values) {
  return kth_smallest([&](auto const& visit) { std::for_each(values.begin(), values.end(), visit); },
                      values.size() / 2);
}

std::vector<double> steps_of(std::vector<double> const& stamps) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < stamps.size(); ++i) steps.push_back(stamps[i] - stamps[i - 1]);
  return steps;
}

// the typical way from one stamp to the next later one
double forward_step(std::vector<double> const& stamps) {
  std::vector<double> forward;
  for (double step : steps_of(stamps))
    if (step > 0.0) forward.push_back(step);
  return forward.empty() ? 0.0 : median_of(forward);
}

// seconds since 1970 between 2001 and 2128, in one of the units that programs write
std::optional<NamedUnit> unit_of_epoch(double stamp) {
  constexpr double earliest_s = 1e9, latest_s = 5e9;
  for (auto const& [word, si] :
       {std::pair("s", 1.0), std::pair("ms", 1e-3), std::pair("us", 1e-6), std::pair("ns", 1e-9)})
    if (stamp * si >= earliest_s && stamp * si <= latest_s) return NamedUnit{word, Quantity::time, si};
  return {};
}

[[noreturn]] void refuse_unit(Examination const& exam, double step) {
  constexpr double slowest_hz = 10.0, fastest_hz = 1e5;
  std::string help;
  for (auto const& [word, si] :
       {std::pair("milliseconds", 1e-3), std::pair("microseconds", 1e-6), std::pair("nanoseconds", 1e-9)}) {
    double const rate_hz = 1.0 / (step * si);
    if (rate_hz >= slowest_hz && rate_hz <= fastest_hz)
      help += fmt::format("recording.time_per_unit = {:g} for {} ({:.6g} Hz), ", si, word, rate_hz);
  }
  throw Error(bad_data(
      fmt::format("the time step is {:.6g} in \"{}\": {:.3g} Hz if these are seconds; are they milliseconds or counts?",
                  step, exam.channels.at("time").column, 1.0 / step),
      exam.table.path, 0, help + "recording.time_per_unit = 1 where they are seconds"));
}

double seconds_per_unit(Examination& exam, std::vector<double> const& stamps) {
  // slower than this no joint is recorded to be identified: a unit is more likely than such a rate
  constexpr double slowest_step_s = 0.1;
  if (exam.writes("time_per_unit")) return exam.options.time_per_unit;
  auto const& column = exam.channels.at("time").column;
  auto unit = unit_of_name(column);
  if (unit && unit->quantity != Quantity::time) unit.reset();
  double const step = forward_step(stamps);
  if (auto const epoch = unit_of_epoch(std::fabs(median_of(stamps))); epoch) unit = epoch;
  if (!unit && step >= slowest_step_s) refuse_unit(exam, step);
  if (unit && unit->word == "s" && step >= 5 * slowest_step_s) refuse_unit(exam, step);
  if (!unit || unit->si == 1.0) return 1.0;
  exam.add(FindingKind::time_unit, Grade::note, Repair::corrected, "time", {}, unit->si, unit->word);
  return unit->si;
}

// A counter that starts anew: moduli of registers, and of the parts of a second, in s for stamps of the unit `per_unit`
std::optional<double> rollover(double fall_s, double step_s, double per_unit) {
  auto const is = [&](double modulus) {
    double const left = modulus - fall_s;  // the ordinary step that remains
    return left >= 0.0 && left <= 3.0 * step_s && modulus > 20.0 * step_s;
  };
  for (double unit : {per_unit, 1e-3, 1e-6, 1e-9}) {
    for (int bits : {16, 24, 31, 32})
      if (is(std::ldexp(unit, bits))) return std::ldexp(unit, bits);
    for (double parts : {1e3, 1e6, 1e9})
      if (is(parts * unit)) return parts * unit;
  }
  for (double seconds : {60.0, 3600.0, 86400.0})
    if (is(seconds)) return seconds;
  return {};
}

void unroll(Examination& exam, std::vector<double>& stamps, double per_unit) {
  double const step = forward_step(stamps);
  double added = 0.0, modulus = 0.0;
  std::vector<std::size_t> rows;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    double const now = stamps[i] + added;
    if (now < stamps[i - 1]) {
      if (auto const found = rollover(stamps[i - 1] - now, step, per_unit); found) {
        added += *found;
        modulus = *found;
        rows.push_back(i);
      }
    }
    stamps[i] += added;
  }
  if (!rows.empty()) exam.add(FindingKind::clock_rolls_over, Grade::warning, Repair::corrected, "time", rows, modulus);
}

void permute(Examination& exam, std::vector<double>& stamps, std::vector<std::size_t> const& places) {
  auto const taken = [&](auto const& values) {
    auto sorted = values;
    for (std::size_t i = 0; i < places.size(); ++i) sorted[i] = values[places[i]];
    return sorted;
  };
  for (auto& [name, channel] : exam.channels) channel.values = taken(channel.values);
  exam.order = taken(exam.order);
  stamps = taken(stamps);
}

// rows of a logger that writes from several threads: every row near the place of its stamp
void sort_rows(Examination& exam, std::vector<double>& stamps) {
  constexpr std::size_t farthest = 64;  // rows, what buffers of loggers hold
  std::vector<std::size_t> backwards;
  for (std::size_t i = 1; i < stamps.size(); ++i)
    if (stamps[i] < stamps[i - 1]) backwards.push_back(i);
  if (backwards.empty()) return;
  std::vector<std::size_t> places(stamps.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::stable_sort(places.begin(), places.end(), [&](auto a, auto b) { return stamps[a] < stamps[b]; });
  std::size_t moved = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    moved = std::max(moved, places[i] > i ? places[i] - i : i - places[i]);
  if (moved > farthest) {
    std::size_t const row = backwards.front();
    throw Error(
        bad_data(fmt::format("time starts anew in {} ({:.9g} -> {:.9g} s)", row_name(exam.table, exam.order[row]),
                             stamps[row - 1], stamps[row]),
                 exam.table.path, line_of(exam.table, exam.order[row]),
                 fmt::format("two recordings in one file? split it at {}", row_name(exam.table, exam.order[row]))));
  }
  exam.add(FindingKind::rows_out_of_order, Grade::warning, Repair::corrected, "time", backwards);
  permute(exam, stamps, places);
}

bool repeats_all(Examination const& exam, std::size_t row) {
  return std::all_of(exam.channels.begin(), exam.channels.end(), [&](auto const& one) {
    auto const& values = one.second.values;
    return one.first == "time" || values[row] == values[row - 1] ||
           (std::isnan(values[row]) && std::isnan(values[row - 1]));
  });
}

// a message that was logged twice: the same stamp, the same values
void drop_repeats(Examination& exam, std::vector<double>& stamps) {
  std::vector<std::size_t> kept, repeated;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    bool const is_repeat = i > 0 && stamps[i] == stamps[i - 1] && repeats_all(exam, i);
    (is_repeat ? repeated : kept).push_back(i);
  }
  // stamps that stand still altogether are another matter, and are refused with the words for it
  if (repeated.empty() || kept.size() < 16) return;
  exam.add(FindingKind::rows_repeated, Grade::note, Repair::left_out, "time", repeated, 0.0, "same stamp, same values");
  exam.repeated = static_cast<Eigen::Index>(repeated.size());
  for (auto& [name, channel] : exam.channels) {
    std::vector<double> values;
    for (std::size_t row : kept) values.push_back(channel.values[row]);
    channel.values = std::move(values);
  }
  std::vector<std::size_t> order;
  std::vector<double> left;
  for (std::size_t row : kept) {
    order.push_back(exam.order[row]);
    left.push_back(stamps[row]);
  }
  exam.order = std::move(order);
  stamps = std::move(left);
}

// Rows that were stamped when they arrived, several at a time: most steps are far shorter than the mean one, and the
// rate over pieces of the recording is the same everywhere, so that none is missing
bool arrive_in_bursts(std::vector<double> const& stamps) {
  constexpr std::size_t pieces = levels::pieces_of_same_rate;
  std::size_t const n = stamps.size();
  double const mean = (stamps.back() - stamps.front()) / static_cast<double>(n - 1);
  double longest = 0.0;
  std::size_t short_steps = 0, bursts = 0;
  for (double step : steps_of(stamps)) {
    short_steps += step < levels::within_burst * mean;
    bursts += step > mean;
    longest = std::max(longest, step);
  }
  if (static_cast<double>(short_steps) < levels::steps_within_bursts * static_cast<double>(n - 1)) return false;
  std::size_t const rows = n / pieces;
  // one long gap among even rows is no burst: the packets come again and again, at about the same distance
  bool const come_again = bursts >= pieces && longest <= levels::longest_pause * (stamps.back() - stamps.front()) /
                                                             static_cast<double>(bursts);
  if (rows < 2 || !come_again) return false;
  for (std::size_t k = 0; k < pieces; ++k) {
    double const seconds = stamps[std::min((k + 1) * rows, n - 1)] - stamps[k * rows];
    double const expected = mean * static_cast<double>(std::min((k + 1) * rows, n - 1) - k * rows);
    if (std::fabs(seconds - expected) > levels::same_rate * expected + longest) return false;
  }
  return true;
}

void spread_bursts(Examination& exam, std::vector<double>& stamps) {
  if (stamps.size() < 20 || !(stamps.back() > stamps.front()) || !arrive_in_bursts(stamps)) return;
  // the straight line through the stamps over the number of the row
  auto const n = static_cast<double>(stamps.size());
  double product = 0.0, square = 0.0;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    double const from_middle = static_cast<double>(i) - (n - 1) / 2;
    product += from_middle * (stamps[i] - stamps.front());
    square += from_middle * from_middle;
  }
  double const rate_hz = roundest(square / product, levels::rate_of_arrivals_known_to);
  for (std::size_t i = 0; i < stamps.size(); ++i) stamps[i] = stamps.front() + static_cast<double>(i) / rate_hz;
  exam.add(FindingKind::stamps_of_arrival, Grade::warning, Repair::corrected, "time", {}, rate_hz);
}

// whole seconds whose fractions stand in a column of their own: the reader has put both together
void take_fractions(Examination& exam) {
  auto& time = exam.channels.at("time");
  std::string const stamp = stamp_with_fractions(exam.table, time.column);
  auto const at = std::find(exam.table.names.begin(), exam.table.names.end(), stamp);
  if (stamp.empty() || at == exam.table.names.end()) return;
  time.column = stamp;
  time.values = exam.table.columns[static_cast<std::size_t>(at - exam.table.names.begin())];
}

}  // namespace

void examine_clock(Examination& exam) {
  take_fractions(exam);
  std::vector<double> stamps = exam.values("time");
  double const per_unit = seconds_per_unit(exam, stamps);
  // from the first row, so that nanoseconds since 1970 keep their digits
  double const first = stamps.front();
  exam.first_stamp_s = first * per_unit;
  exam.stamp_unit_s = single_precision_unit(stamps) * per_unit;
  for (double& stamp : stamps) stamp = (stamp - first) * per_unit;
  unroll(exam, stamps, per_unit);
  sort_rows(exam, stamps);
  drop_repeats(exam, stamps);
  if (!exam.table.has_merged_clocks) spread_bursts(exam, stamps);  // rows of two clocks stand unevenly
  exam.time_s = std::move(stamps);
}

void close_set_clock(Examination& exam) {
  constexpr double long_step = 10.0, goes_on = 0.5;
  auto const& q = exam.values("position");
  auto& time = exam.time_s;
  double const step = forward_step(time);
  if (!(step > 0.0)) return;
  double taken = 0.0, closed = 0.0;
  std::vector<std::size_t> rows;
  for (std::size_t i = 3; i + 3 < time.size(); ++i) {
    double const now = time[i] - taken - time[i - 1];
    time[i] -= taken;
    if (!(now > long_step * step)) continue;
    double const before = q[i - 1] - q[i - 2], over = q[i] - q[i - 1], after = q[i + 1] - q[i];
    // both sides move alike, fast enough to have gone far in so long a time, and the step between is theirs
    bool const moves = before * after > 0.0 && std::fabs(before - after) <= goes_on * std::fabs(before + after) / 2;
    double const expected = (before + after) / 2;
    if (!moves || std::fabs(over - expected) > goes_on * std::fabs(expected)) continue;
    taken += now - step;
    time[i] = time[i - 1] + step;
    closed = now - step;
    rows.push_back(i);
  }
  for (std::size_t i = time.size() >= 3 ? time.size() - 3 : 0; i < time.size(); ++i) time[i] -= taken;
  if (!rows.empty()) exam.add(FindingKind::clock_was_set, Grade::warning, Repair::corrected, "time", rows, closed);
}

}  // namespace torquescope
