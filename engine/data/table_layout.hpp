#pragma once
// Where the column names, a row of units and the first row of numbers stand in a delimited text.
//
// Method     the first three lines in a row that are mostly numbers, with one count of cells, are rows; the names are
//            the line of words with as many cells right above them; a line of units may stand between, and a line
//            of groups ("Axis 1,,Axis 2,") above names that repeat
// Scope      the first 200 lines; nothing is told of a text that has no such lines
// Threads    functions of their arguments

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace torquescope {

struct TableLayout {
  char separator = ',';
  std::int64_t first_text_line = 0;  // not empty, no comment; above names_line: a preamble
  std::int64_t groups_line = 0;      // right above names that repeat, and with which they do not: 0: none
  std::int64_t names_line = 0;
  std::int64_t units_line = 0;  // 0: none
  std::int64_t rows_line = 0;
};

std::optional<TableLayout> layout_of(std::string_view text);

// each name with its group, which counts until the next one begins: "Axis 1.Position"
std::vector<std::string> with_groups(std::vector<std::string> const& names,
                                     std::vector<std::string_view> const& groups);

// "[rad/s]" -> "rad/s"
std::string unit_in(std::string_view cell);
bool is_known_unit(std::string_view unit);

}  // namespace torquescope
