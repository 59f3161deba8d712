#pragma once
// Problems with a recording's data (exit code 65), and where its rows stand.

#include <cstdint>
#include <string>
#include <utility>

#include "engine/data/recording_reader.hpp"

namespace torquescope {

// line 0: nowhere in particular in the file
inline Problem bad_data(std::string what, std::string path, std::int64_t line, std::string help) {
  Problem problem;
  problem.code = ExitCode::bad_data;
  problem.what = std::move(what);
  problem.place.file = std::move(path);
  problem.place.line = static_cast<int>(line);
  problem.help = std::move(help);
  return problem;
}

// "line 812" of a text file, else "row 811" (rows count from 1)
inline std::string row_name(RawTable const& table, std::size_t row) {
  return table.line_of_row.empty() ? "row " + std::to_string(row + 1)
                                   : "line " + std::to_string(table.line_of_row[row]);
}

inline std::int64_t line_of(RawTable const& table, std::size_t row) {
  return table.line_of_row.empty() ? 0 : table.line_of_row[row];
}

}  // namespace torquescope
