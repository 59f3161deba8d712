#include "engine/data/block_lengths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/data/column_name.hpp"
#include "engine/data/data_problem.hpp"

namespace torquescope {
namespace {

bool rises(std::vector<double> const& values) {
  constexpr std::size_t fewest = 16;
  return values.size() >= fewest && std::isfinite(values.front()) &&
         std::adjacent_find(values.begin(), values.end(), [](double a, double b) { return !(b > a); }) == values.end();
}

bool says_time(std::string const& name) { return column_role(parse_column_name(name)).quantity == WordKind::time; }

bool begins_with_t(std::string const& name) {
  auto const last = name.find_last_of("./");
  char const first = name[last == std::string::npos || last + 1 == name.size() ? 0 : last + 1];
  return first == 't' || first == 'T';
}

// place of a column that a job names by the whole or by its end
std::optional<std::size_t> place_of(RawTable const& table, std::string const& named) {
  auto const is_it = [&](std::string const& name) { return name == named || name.ends_with("/" + named); };
  auto const found = std::find_if(table.names.begin(), table.names.end(), is_it);
  if (found == table.names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - table.names.begin());
}

}  // namespace

std::optional<std::size_t> clock_among(std::vector<std::string> const& names,
                                       std::vector<std::vector<double>> const& columns,
                                       std::vector<std::size_t> const& block) {
  for (auto const& is_called : {says_time, begins_with_t}) {
    std::vector<std::size_t> clocks;
    for (std::size_t c : block)
      if (is_called(names[c]) && rises(columns[c])) clocks.push_back(c);
    if (clocks.size() == 1) return clocks.front();
    if (!clocks.empty()) return std::nullopt;
  }
  return std::nullopt;
}

bool run_together(std::vector<double> const& one, std::vector<double> const& other) {
  double const shared = std::min(one.back(), other.back()) - std::max(one.front(), other.front());
  return shared > 0.5 * std::min(one.back() - one.front(), other.back() - other.front());
}

void check_block_lengths(RawTable const& table, RecordingOptions const& options) {
  auto const time = options.columns.find("time");
  std::vector<Problem> problems;
  std::optional<std::size_t> first;
  for (auto const& [channel, column] : options.columns) {
    auto const own = options.clocks.find(channel);
    auto const at = place_of(table, column);
    auto clock = own != options.clocks.end()     ? place_of(table, own->second)
                 : time != options.columns.end() ? place_of(table, time->second)
                                                 : first;
    if (!first) first = at;
    if (!at || !clock || table.lengths[*at] == table.lengths[*clock]) continue;
    auto problem = bad_data(fmt::format("\"{}\" has {} values, and \"{}\" has {}", table.names[*at], table.lengths[*at],
                                        table.names[*clock], table.lengths[*clock]),
                            table.path, 0,
                            channel == "position" || channel == "time"
                                ? fmt::format("columns.time = \"{}\"", table.clocks[*at])
                                : fmt::format("clocks = {{{} = \"{}\"}} in [recording]", channel, table.clocks[*at]));
    problem.key = fmt::format("recording.columns.{}", channel);
    problems.push_back(std::move(problem));
  }
  if (!problems.empty()) throw Error(std::move(problems));
}

RawTable block_of(RawTable const& table, std::string const& column) {
  auto const at = place_of(table, column);
  if (!at) return table;
  RawTable block{table.path, table.sha256, {}, {}, table.line_of_row, table.unusable};
  block.remarks = table.remarks;
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    if (table.clocks[c] != table.clocks[*at]) continue;
    auto const length = static_cast<std::ptrdiff_t>(table.lengths[c]);
    block.names.push_back(table.names[c]);
    block.columns.emplace_back(table.columns[c].begin(), table.columns[c].begin() + length);
  }
  return block;
}

}  // namespace torquescope
