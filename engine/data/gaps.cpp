#include "engine/data/gaps.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/data/data_problem.hpp"

namespace torquescope {
namespace {

struct Gap {
  std::size_t first, count;
};

std::vector<Gap> gaps_of(std::vector<double> const& values) {
  std::vector<Gap> gaps;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    if (gaps.empty() || gaps.back().first + gaps.back().count != i) gaps.push_back({i, 0});
    ++gaps.back().count;
  }
  return gaps;
}

std::size_t total(std::vector<Gap> const& gaps) {
  std::size_t sum = 0;
  for (auto const& gap : gaps) sum += gap.count;
  return sum;
}

bool can_fill(Gap const& gap, std::size_t n_rows) {
  return gap.count <= longest_filled_gap && gap.first > 0 && gap.first + gap.count < n_rows;
}

void fill(std::vector<double>& values, Gap const& gap) {
  double const before = values[gap.first - 1], after = values[gap.first + gap.count];
  for (std::size_t k = 0; k < gap.count; ++k)
    values[gap.first + k] = before + (after - before) * static_cast<double>(k + 1) / static_cast<double>(gap.count + 1);
}

std::vector<std::string> time_note(Channels const& channels, std::size_t row) {
  auto const time = channels.find("time");
  if (time == channels.end() || !std::isfinite(time->second.values[row])) return {};
  return {fmt::format("t = {:.3f} s", time->second.values[row])};
}

Problem refused(Channel const& channel, std::vector<Gap> const& gaps, RawTable const& table, Channels const& channels) {
  std::size_t const row = gaps.front().first, count = total(gaps);
  auto problem =
      bad_data(fmt::format("{} value{} of \"{}\" {} not {}, first in {}", count, count == 1 ? "" : "s", channel.column,
                           count == 1 ? "is" : "are", count == 1 ? "a number" : "numbers", row_name(table, row)),
               table.path, line_of(table, row), "");
  problem.notes = time_note(channels, row);
  problem.help =
      fmt::format("cut the recording there, or recording.gaps = \"fill\" (up to {} samples)", longest_filled_gap);
  return problem;
}

Problem cannot_fill(Channel const& channel, Gap const& gap, RawTable const& table, Channels const& channels) {
  bool const too_long = gap.count > longest_filled_gap;
  auto problem = bad_data(too_long ? fmt::format("{} values in a row of \"{}\" are not numbers, from {}", gap.count,
                                                 channel.column, row_name(table, gap.first))
                                   : fmt::format("\"{}\" {} without a number ({})", channel.column,
                                                 gap.first == 0 ? "begins" : "ends", row_name(table, gap.first)),
                          table.path, line_of(table, gap.first), "");
  problem.notes = time_note(channels, gap.first);
  problem.help =
      too_long ? fmt::format("cut the recording there: gaps = \"fill\" closes up to {} samples", longest_filled_gap)
               : "delete those lines: a value is filled only between two numbers";
  return problem;
}

}  // namespace

std::vector<DataWarning> close_gaps(Channels& channels, RawTable const& table, RecordingOptions const& options) {
  std::vector<DataWarning> warnings;
  std::vector<Problem> problems;
  for (auto& [name, channel] : channels) {
    auto const gaps = gaps_of(channel.values);
    if (gaps.empty()) continue;
    if (options.gaps != "fill") {
      problems.push_back(refused(channel, gaps, table, channels));
      continue;
    }
    for (auto const& gap : gaps) {
      if (can_fill(gap, channel.values.size()))
        fill(channel.values, gap);
      else
        problems.push_back(cannot_fill(channel, gap, table, channels));
    }
    warnings.push_back({"gaps", fmt::format("{} missing values of \"{}\" filled in {} places, first in {}", total(gaps),
                                            channel.column, gaps.size(), row_name(table, gaps.front().first))});
  }
  if (!problems.empty()) throw Error(std::move(problems));
  return warnings;
}

}  // namespace torquescope
