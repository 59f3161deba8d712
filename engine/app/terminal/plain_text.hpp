#pragma once
// Texts as a terminal shows them: their width, their line breaks, and nothing in them that a terminal would obey.
//
// Width      one column per code point (no wide letters): file names and messages, not typesetting
// Threads    pure functions

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace torquescope {

inline constexpr int widest_page = 80;  // no line of ours is longer, however wide the window is
// columns that a line of ours may take, 40 to widest_page: of COLUMNS, else of the window behind standard output
int page_width();

// control characters and broken UTF-8 become '?', tabs one space: a job or a recording must not steer the terminal
std::string printable(std::string_view text);

int columns_of(std::string_view utf8);  // escape sequences of Ink do not count

// breaks at spaces; the first line has `first_width` columns, the others `width`. Words longer than a line stay whole:
// half a path is of no use.
std::vector<std::string> wrap(std::string const& text, int first_width, int width);

// `text` wrapped to the page behind `lead`, further lines below its end: "  help: write ...\n"; ends with a line feed
std::string hanging(std::string const& lead, std::string const& text, int width = page_width());

// of a paragraph of a diagnosis: "where  ", "what   ", "why    ", "next   "
inline constexpr int lead_columns = 7;
std::string lead(std::string const& topic);

std::string pad_right(std::string text, int columns);  // text, then spaces
std::string pad_left(std::string text, int columns);   // spaces, then text

std::string count_text(std::int64_t count);    // "183 000"
std::string bytes_text(std::uintmax_t bytes);  // "3.1 MB"
std::string seconds_text(double seconds);      // "4.2 s", "3 min 20 s", "2 h 5 min"

}  // namespace torquescope
