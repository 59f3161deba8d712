#include "engine/data/own_clocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/file_bytes.hpp"

namespace torquescope {
namespace {

struct Clock {
  std::string column;
  std::vector<double> const* stamps = nullptr;
  std::vector<std::pair<std::string, std::vector<double> const*>> channels{};  // their columns
};

// one row of one clock
struct Row {
  double stamp = 0.0;
  std::size_t clock = 0, row = 0;
};

// the whole name of a column that a job names by the whole or by its end
std::optional<std::string> whole_name(RawTable const& table, std::string const& named) {
  std::vector<std::string> ending;
  for (auto const& name : table.names) {
    if (name == named) return name;
    if (name.ends_with("/" + named)) ending.push_back(name);
  }
  return ending.size() == 1 ? std::optional(ending.front()) : std::nullopt;
}

void check_clocks(RawTable const& table, RecordingOptions const& options, Section const& section) {
  std::vector<Problem> problems;
  auto const refuse = [&](std::string what, std::string help) {
    problems.push_back(problem_at(section, "clocks", std::move(what), std::move(help)));
  };
  if (!options.columns.contains("time"))
    refuse("clocks without columns.time", "columns.time = the column with the position's time stamps");
  for (auto const& [channel, clock] : options.clocks) {
    if (channel == "time" || channel == "position" || channel == "velocity")
      refuse(fmt::format("clocks.{} is the clock of the recording", channel), "write it as columns.time");
    else if (!options.columns.contains(channel))
      refuse(fmt::format("clocks.{} = \"{}\" is of no channel of columns", channel, clock),
             fmt::format("columns.{} = the column with its values", channel));
    if (!whole_name(table, clock))
      refuse(fmt::format("no column \"{}\" in {}", clock, file_name(table)),
             fmt::format("the file has {}", fmt::join(table.names, ", ")));
  }
  if (!problems.empty()) throw Error(std::move(problems));
}

std::vector<Clock> clocks_of(RawTable const& table, Channels const& channels, RecordingOptions const& options) {
  std::vector<Clock> clocks{{channels.at("time").column, &channels.at("time").values}};
  for (auto const& [name, channel] : channels) {
    if (name == "time") continue;
    auto const own = options.clocks.find(name);
    std::string const column = own == options.clocks.end() ? clocks.front().column : *whole_name(table, own->second);
    auto at = std::find_if(clocks.begin(), clocks.end(), [&](Clock const& clock) { return clock.column == column; });
    if (at == clocks.end()) at = clocks.insert(clocks.end(), {column, &values_of(table, column)});
    at->channels.emplace_back(channel.column, &channel.values);
  }
  return clocks;
}

// rows with a stamp; blocks of columns that are shorter than others end in empty cells
void add_rows(std::vector<Row>& rows, Clock const& clock, std::size_t number, RawTable const& table) {
  double before = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < clock.stamps->size(); ++k) {
    double const stamp = (*clock.stamps)[k];
    bool const has_value = std::any_of(clock.channels.begin(), clock.channels.end(),
                                       [&](auto const& one) { return std::isfinite((*one.second)[k]); });
    validate(std::isfinite(stamp) || !has_value, [&] {
      return bad_data(
          fmt::format("\"{}\" has no stamp in {}, where its channels have values", clock.column, row_name(table, k)),
          table.path, line_of(table, k), "delete that line: without its time a row has no place");
    });
    if (!std::isfinite(stamp)) continue;
    validate(stamp >= before, [&] {
      return bad_data(fmt::format("the clock \"{}\" runs backwards in {} ({:.9g} -> {:.9g})", clock.column,
                                  row_name(table, k), before, stamp),
                      table.path, line_of(table, k), fmt::format("split the recording at {}", row_name(table, k)));
    });
    before = stamp;
    rows.push_back({stamp, number, k});
  }
}

RawTable merged_table(RawTable const& table, std::vector<Clock> const& clocks, std::vector<Row> const& rows) {
  std::size_t n_columns = 1;
  for (auto const& clock : clocks) n_columns += clock.channels.size();
  validate(rows.size() * n_columns <= most_table_values, [&] {
    return bad_data(fmt::format("{} rows of all clocks hold more than {} numbers", rows.size(), most_table_values),
                    table.path, 0, "cut it into several recordings: recording.train takes a list");
  });
  RawTable merged{table.path, table.sha256, {clocks.front().column}, {{}}};
  merged.remarks = table.remarks;
  merged.has_merged_clocks = true;
  std::vector<std::pair<std::size_t, std::vector<double> const*>> sources;  // clock and values of each further column
  for (std::size_t c = 0; c < clocks.size(); ++c)
    for (auto const& [column, values] : clocks[c].channels) {
      merged.names.push_back(column);
      sources.emplace_back(c, values);
    }
  merged.columns.resize(merged.names.size());
  auto& stamps = merged.columns.front();
  std::vector<std::size_t> last(clocks.size(), std::numeric_limits<std::size_t>::max());  // merged row of each clock's
  for (auto const& row : rows) {
    // one row for equal stamps of different clocks
    bool const is_new = stamps.empty() || stamps.back() != row.stamp || last[row.clock] == stamps.size() - 1;
    if (is_new) {
      stamps.push_back(row.stamp);
      for (std::size_t c = 1; c < merged.columns.size(); ++c)
        merged.columns[c].push_back(std::numeric_limits<double>::quiet_NaN());
      if (!table.line_of_row.empty()) merged.line_of_row.push_back(table.line_of_row[row.row]);
    }
    last[row.clock] = stamps.size() - 1;
    for (std::size_t c = 0; c < sources.size(); ++c)
      if (sources[c].first == row.clock) merged.columns[c + 1].back() = (*sources[c].second)[row.row];
  }
  if (!table.units.empty())
    for (auto const& name : merged.names) {
      auto const at = std::find(table.names.begin(), table.names.end(), name) - table.names.begin();
      merged.units.push_back(table.units.at(static_cast<std::size_t>(at)));
    }
  return merged;
}

}  // namespace

RawTable on_one_clock(RawTable const& table, RecordingOptions const& options, Section const& section,
                      TorqueColumn torque) {
  check_clocks(table, options, section);
  auto const channels = pick_channels(table, options, section, torque);
  auto const clocks = clocks_of(table, channels, options);
  std::vector<Row> rows;
  for (std::size_t c = 0; c < clocks.size(); ++c) add_rows(rows, clocks[c], c, table);
  std::stable_sort(rows.begin(), rows.end(), [](Row const& a, Row const& b) { return a.stamp < b.stamp; });
  RawTable merged = merged_table(table, clocks, rows);
  std::string others;
  for (std::size_t c = 1; c < clocks.size(); ++c) others += (c > 1 ? ", \"" : "\"") + clocks[c].column + "\"";
  merged.remarks.push_back(fmt::format("Channels with clocks of their own ({}) were put on the clock \"{}\".", others,
                                       clocks.front().column));
  return merged;
}

}  // namespace torquescope
