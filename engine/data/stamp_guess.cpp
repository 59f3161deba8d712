#include "engine/data/stamp_guess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/median.hpp"
#include "engine/data/column_suggestion.hpp"
#include "engine/data/columns.hpp"
#include "engine/data/ros_stamp.hpp"

namespace torquescope {
namespace {

constexpr double shortest_step_s = 1e-5, longest_step_s = 0.5;

// some rows may stand in the wrong order, and a counter may start anew: a clock all the same
bool runs_forwards(std::vector<double> const& stamps) {
  std::size_t forwards = 0, backwards = 0;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    forwards += stamps[i] > stamps[i - 1];
    backwards += stamps[i] < stamps[i - 1];
  }
  return 10 * backwards < forwards;
}

// of the steps that are steps: stamps may repeat
double median_step(std::vector<double> const& stamps) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < stamps.size(); ++i)
    if (stamps[i] > stamps[i - 1]) steps.push_back(stamps[i] - stamps[i - 1]);
  return upper_median(std::move(steps));
}

bool suits_a_recording(double step_s) { return step_s >= shortest_step_s && step_s < longest_step_s; }

struct StampUnit {
  double per_unit;
  char const* name;
};
constexpr StampUnit stamp_units[] = {
    {1.0, "seconds"}, {1e-3, "milliseconds"}, {1e-6, "microseconds"}, {1e-9, "nanoseconds"}};

// stamps of this century count up from 1970
std::optional<StampUnit> since_1970(double stamp) {
  constexpr double year_2001 = 1e9, year_2096 = 4e9;
  for (auto const& unit : stamp_units)
    if (stamp * unit.per_unit >= year_2001 && stamp * unit.per_unit < year_2096) return unit;
  return {};
}

StampUnit by_step(double step) {
  if (step < longest_step_s) return stamp_units[0];
  if (step < 100.0) return stamp_units[1];
  return step < 1e5 ? stamp_units[2] : stamp_units[3];
}

void guess_unit(StampGuess& guess, LikelyColumn const& likely, double first, double step) {
  auto const& unit = likely.name.unit;
  bool const named = unit && unit->quantity == Quantity::time;
  if (named && suits_a_recording(step * unit->si)) {
    guess.per_unit = unit->si;
    guess.why = fmt::format("the name says {}", unit->word);
    return;
  }
  auto const epoch = since_1970(first);
  auto const likely_unit = epoch && suits_a_recording(step * epoch->per_unit) ? *epoch : by_step(step);
  guess.per_unit = likely_unit.per_unit;
  guess.unit = epoch ? Certainty::sure : Certainty::by_values;
  guess.why = epoch ? fmt::format("{} since 1970", likely_unit.name)
                    : fmt::format("a step of {:.4g} suits {}", step, likely_unit.name);
  bool const may_count_rows = step == 1.0;
  if (named || may_count_rows) guess.unit = Certainty::doubtful;
  if (named) guess.why += fmt::format(", though the name says {}", unit->word);
  if (may_count_rows) guess.why += "; it may count rows";
}

bool has_nanoseconds_beside(std::vector<LikelyColumn> const& likely, LikelyColumn const& whole) {
  if (!whole.name.unit || whole.name.unit->si != 1.0) return false;
  return std::any_of(likely.begin(), likely.end(), [&](LikelyColumn const& part) {
    return part.name.unit && part.name.unit->si == 1e-9 && part.name.rest == whole.name.rest;
  });
}

// the stamp was put together of seconds and these: alone they begin anew every second
bool is_part_of_a_stamp(RawTable const& table, std::vector<LikelyColumn> const& likely, LikelyColumn const& part) {
  return std::any_of(likely.begin(), likely.end(), [&](LikelyColumn const& whole) {
    return has_nanoseconds_beside({part}, whole) && !stamp_with_fractions(table, whole.column).empty();
  });
}

}  // namespace

std::optional<StampGuess> guess_stamps(RawTable const& table, std::string const& named) {
  auto likely = likely_columns("time", table.names, table.units);
  if (!named.empty()) {
    std::erase_if(likely, [&](LikelyColumn const& one) { return one.column != named; });
    if (likely.empty()) likely.push_back({named, parse_column_name(named), {}});
  }
  for (auto const& candidate : likely) {
    auto const& stamps = values_of(table, candidate.column);
    if (has_nanoseconds_beside(likely, candidate) || is_part_of_a_stamp(table, likely, candidate)) continue;
    if (!runs_forwards(stamps)) continue;
    StampGuess guess;
    guess.column = candidate.column;
    guess_unit(guess, candidate, stamps.front(), median_step(stamps));
    return guess;
  }
  return {};
}

}  // namespace torquescope
