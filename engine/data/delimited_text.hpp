#pragma once
// Lines, cells and numbers of delimited text: what CSV means here.
//
// Separator  comma, semicolon or tab, whichever the header has most of outside quotes; else runs of blanks
// Cells      blanks around them do not count; "quoted" cells may hold separators
// Numbers    std::from_chars (no locale): 1, -2.5e-3, +4, 1.#INF; missing: empty, nan, NA, N/A, null, None, --, -1.#IND
//            and what else programs write for no number
// Threads    functions of their arguments

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace torquescope {

// the lines of a text, however it ends them (LF, CRLF, CR), counted from 1; neither copies
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}
  bool next(std::string_view& line);
  std::int64_t line_number() const { return line_number_; }
  bool at_end() const;                             // nothing but empty lines follows
  bool line_ended() const { return line_ended_; }  // the last line was ended by LF or CR, not by the end of the text

 private:
  std::string_view rest_;
  std::int64_t line_number_ = 0;
  bool line_ended_ = true;
};

inline constexpr char blanks = ' ';  // as a separator: any run of spaces and tabs

char separator_of(std::string_view header);
// the cells still with their quotes; a trailing separator makes an empty last cell
void split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells);
std::string unquoted(std::string_view cell);

enum class CellKind { number, missing, text };
CellKind read_cell(std::string_view cell, double& value);  // value: NaN unless it is a number

// the same where the decimal mark is a comma: "-0,25", never "1.234,5"
CellKind read_comma_cell(std::string_view cell, double& value);

std::string lower_case(std::string_view text);  // of ASCII letters

// a cell as it may stand in a message: at most 40 printable letters
std::string shown(std::string_view cell);

}  // namespace torquescope
