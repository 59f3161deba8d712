#pragma once
// What every examination of this folder works on: the channels of one recording in the order of time.
//
// Cells      a value that is missing, or that an examination has found wrong, is NaN; it is filled over time later
// Lines      line(row) is what a person looks up: the line of a text file, else the row counted from 1
// Threads    one recording, one thread

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "engine/data/columns.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/finding.hpp"

namespace torquescope {

// a cell without a value
inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();

struct Examination {
  RawTable const& table;
  RecordingOptions const& options;
  Section const& section;        // the job's [recording]
  Channels channels;             // rows in the order of time
  std::vector<double> time_s{};  // of each row; empty while the clock is not known
  double first_stamp_s = 0.0;
  double stamp_unit_s = 0.0;         // the spacing of the stamps in the file, where they are of single precision
  std::vector<std::size_t> order{};  // row of the table that each row is
  std::vector<Finding> findings{};
  std::map<std::string, double> source_hz{};  // of channels that are renewed less often than they are logged
  Eigen::Index repeated = 0;                  // rows that were logged twice, and dropped

  bool has(std::string const& channel) const { return channels.contains(channel); }
  std::vector<double>& values(std::string const& channel) { return channels.at(channel).values; }
  std::size_t rows() const { return order.size(); }
  std::int64_t line(std::size_t row) const {
    return table.line_of_row.empty() ? static_cast<std::int64_t>(order[row]) + 1 : table.line_of_row[order[row]];
  }
  bool writes(std::string_view key) const { return section.find(key) != nullptr; }

  // adds a finding about these rows of a channel's column
  Finding& add(FindingKind kind, Grade grade, Repair repair, std::string const& channel,
               std::vector<std::size_t> const& bad_rows, double size = 0.0, std::string detail = {}) {
    constexpr std::size_t most_lines = 5;
    Finding finding{.kind = kind, .grade = grade, .repair = repair, .recording = file_name(table)};
    finding.column = has(channel) ? channels.at(channel).column : channel;
    finding.count = static_cast<std::int64_t>(bad_rows.size());
    for (std::size_t k = 0; k < bad_rows.size() && k < most_lines; ++k) finding.lines.push_back(line(bad_rows[k]));
    finding.size = size;
    finding.detail = std::move(detail);
    findings.push_back(std::move(finding));
    return findings.back();
  }
};

// largest less smallest of the values that are numbers
inline double range_of(std::vector<double> const& values) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (double value : values) {
    if (!std::isfinite(value)) continue;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  return most - least;
}

inline bool are_whole_numbers(std::vector<double> const& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return !std::isfinite(v) || v == std::round(v); });
}

// rows of `values` that hold a number
inline std::vector<std::size_t> known_rows(std::vector<double> const& values) {
  std::vector<std::size_t> rows;
  rows.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i])) rows.push_back(i);
  return rows;
}

}  // namespace torquescope
