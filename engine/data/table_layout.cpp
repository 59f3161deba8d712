#include "engine/data/table_layout.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "engine/data/delimited_text.hpp"
#include "engine/data/list_cells.hpp"
#include "engine/data/time_stamp.hpp"

namespace torquescope {
namespace {

constexpr std::size_t most_lines = 200, most_bytes = std::size_t{1} << 20;

struct Line {
  std::string_view text;
  std::int64_t number = 0;
};

// the lines at the beginning that are neither empty nor comments
std::vector<Line> first_lines(std::string_view text) {
  LineReader reader(text.substr(0, most_bytes));
  bool const all = text.size() <= most_bytes;
  std::vector<Line> lines;
  for (std::string_view line; lines.size() < most_lines && reader.next(line);) {
    if (!all && !reader.line_ended()) break;
    auto const first = line.find_first_not_of(" \t");
    if (first != std::string_view::npos && line[first] != '#') lines.push_back({line, reader.line_number()});
  }
  return lines;
}

struct Cells {
  std::vector<std::string_view> all;
  std::size_t n_named = 0;                              // without empty ones at the end
  std::size_t n_numbers = 0, n_words = 0, n_units = 0;  // the others are missing

  Cells(std::string_view line, char separator) {
    split_cells(line, separator, all);
    n_named = all.size();
    while (n_named > 1 && all[n_named - 1].empty()) --n_named;
    for (auto cell : all) count(cell, separator);
  }
  bool is_row() const { return 2 * n_numbers > n_numbers + n_words; }
  bool is_words() const { return n_words > 0 && (n_numbers == 0 || n_units == n_numbers + n_words); }

 private:
  void count(std::string_view cell, char separator) {
    double ignored = 0.0;
    auto kind = read_cell(cell, ignored);
    bool const maybe_comma = separator != ',' || cell.starts_with('"');
    if (kind == CellKind::text && maybe_comma) kind = read_comma_cell(cell, ignored);
    if (kind == CellKind::text && !list_elements(cell).empty()) kind = CellKind::number;
    bool const is_stamp = kind == CellKind::text && read_stamp(unquoted(cell), ignored) != StampKind::none;
    n_numbers += kind == CellKind::number || is_stamp;
    n_words += kind == CellKind::text && !is_stamp;
    n_units += kind != CellKind::missing && is_known_unit(unit_in(cell));
  }
};

// a separator may stand at the end of the rows
bool can_name(Cells const& names, Cells const& row) {
  std::size_t const n = row.all.size();
  return names.n_named == n || (names.n_named + 1 == n && row.all.back().empty());
}

// a comma may be a decimal mark where anything else separates the cells
char row_separator(std::string_view line) {
  for (char separator : {';', '\t', ','}) {
    Cells const cells(line, separator);
    if (cells.all.size() > 1 && cells.is_row()) return separator;
  }
  return blanks;
}

bool begins_rows(std::vector<Line> const& lines, std::size_t at, char separator) {
  constexpr std::size_t enough = 3;
  Cells const first(lines[at].text, separator);
  for (std::size_t k = at; k < std::min(at + enough, lines.size()); ++k) {
    Cells const cells(lines[k].text, separator);
    if (!cells.is_row() || cells.all.size() != first.all.size()) return false;
  }
  return true;
}

bool all_differ(Cells const& cells) {
  std::set<std::string_view> const different(cells.all.begin(),
                                             cells.all.begin() + static_cast<std::ptrdiff_t>(cells.n_named));
  return different.size() == cells.n_named && !different.contains("");
}

bool are_units(Cells const& cells) { return cells.n_units > 0 && 2 * cells.n_units >= cells.n_words; }

// whether the line above names that repeat tells them apart
bool has_groups(std::vector<Line> const& lines, std::size_t names, char separator, std::size_t n_columns) {
  if (names == 0) return false;
  Cells const cells(lines[names].text, separator), above(lines[names - 1].text, separator);
  if (all_differ(cells) || !above.is_words() || above.all.size() < n_columns) return false;
  std::vector<std::string> const plain(cells.all.begin(), cells.all.end());
  auto const whole = with_groups(plain, above.all);
  return std::set<std::string>(whole.begin(), whole.end()).size() == whole.size();
}

// whether `lower` describes the columns that `upper` names
bool describes(Cells const& lower, Cells const& upper, bool only_two_at_the_top) {
  if (!all_differ(upper)) return false;  // a row of groups above the names
  bool const mostly_units = are_units(lower);
  constexpr std::size_t enough_columns = 3;  // two cells may be a setting and its value
  return mostly_units || !all_differ(lower) || (only_two_at_the_top && upper.n_named >= enough_columns);
}

}  // namespace

std::vector<std::string> with_groups(std::vector<std::string> const& names,
                                     std::vector<std::string_view> const& groups) {
  std::vector<std::string> whole;
  std::string group;
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (c < groups.size() && !groups[c].empty()) group = unquoted(groups[c]);
    whole.push_back(group.empty() ? names[c] : group + "." + names[c]);
  }
  return whole;
}

std::string unit_in(std::string_view cell) {
  std::string unit = unquoted(cell);
  bool const bracketed =
      unit.size() > 1 && ((unit.front() == '[' && unit.back() == ']') || (unit.front() == '(' && unit.back() == ')') ||
                          (unit.front() == '{' && unit.back() == '}'));
  if (bracketed) unit = unit.substr(1, unit.size() - 2);
  auto const first = unit.find_first_not_of(' ');
  return first == std::string::npos ? "" : unit.substr(first, unit.find_last_not_of(' ') - first + 1);
}

bool is_known_unit(std::string_view unit) {
  static std::set<std::string, std::less<>> const known{"s",
                                                        "sec",
                                                        "secs",
                                                        "second",
                                                        "seconds",
                                                        "ms",
                                                        "msec",
                                                        "us",
                                                        "usec",
                                                        "\xc2\xb5s",
                                                        "\xce\xbcs",
                                                        "\xb5s",
                                                        "ns",
                                                        "min",
                                                        "h",
                                                        "rad",
                                                        "mrad",
                                                        "urad",
                                                        "deg",
                                                        "degree",
                                                        "degrees",
                                                        "\xc2\xb0",
                                                        "\xb0",
                                                        "rev",
                                                        "revs",
                                                        "turn",
                                                        "turns",
                                                        "m",
                                                        "mm",
                                                        "um",
                                                        "cm",
                                                        "inch",
                                                        "in",
                                                        "rad/s",
                                                        "mrad/s",
                                                        "deg/s",
                                                        "\xc2\xb0/s",
                                                        "\xb0/s",
                                                        "rev/s",
                                                        "rpm",
                                                        "1/min",
                                                        "min-1",
                                                        "u/min",
                                                        "m/s",
                                                        "mm/s",
                                                        "rad/s2",
                                                        "rad/s^2",
                                                        "rad/s\xc2\xb2",
                                                        "rad/s**2",
                                                        "deg/s2",
                                                        "deg/s^2",
                                                        "m/s2",
                                                        "m/s^2",
                                                        "nm",
                                                        "n m",
                                                        "n.m",
                                                        "n*m",
                                                        "n\xc2\xb7m",
                                                        "mnm",
                                                        "knm",
                                                        "ncm",
                                                        "nmm",
                                                        "kgf.cm",
                                                        "kgcm",
                                                        "lbf.ft",
                                                        "lb-ft",
                                                        "n",
                                                        "kn",
                                                        "kgf",
                                                        "a",
                                                        "ma",
                                                        "arms",
                                                        "apk",
                                                        "v",
                                                        "mv",
                                                        "kv",
                                                        "w",
                                                        "kw",
                                                        "va",
                                                        "hz",
                                                        "khz",
                                                        "k",
                                                        "\xc2\xb0"
                                                        "c",
                                                        "\xb0"
                                                        "c",
                                                        "degc",
                                                        "c",
                                                        "%",
                                                        "permil",
                                                        "\xe2\x80\xb0",
                                                        "0.1%",
                                                        "bar",
                                                        "pa",
                                                        "counts",
                                                        "count",
                                                        "cnt",
                                                        "cnts",
                                                        "inc",
                                                        "incs",
                                                        "ticks",
                                                        "lsb",
                                                        "bit",
                                                        "bits",
                                                        "1",
                                                        "-",
                                                        "--",
                                                        "none",
                                                        "n/a",
                                                        "bool",
                                                        "enum",
                                                        "raw",
                                                        "ohm",
                                                        "g",
                                                        "kg"};
  return known.contains(lower_case(unit));
}

std::optional<TableLayout> layout_of(std::string_view text) {
  auto const lines = first_lines(text);
  std::size_t row = 0;
  char separator = ',';
  for (; row < lines.size(); ++row) {
    separator = row_separator(lines[row].text);
    if (begins_rows(lines, row, separator)) break;
  }
  if (row == lines.size()) return std::nullopt;
  Cells const first_row(lines[row].text, separator);

  // lines of words above the rows with as many cells, the nearest first
  std::vector<std::size_t> candidates;
  for (std::size_t k = row; k-- > 0;) {
    Cells const cells(lines[k].text, separator);
    if (!cells.is_words()) break;
    if (can_name(cells, first_row)) candidates.push_back(k);
  }
  if (candidates.empty()) return std::nullopt;
  std::size_t names = candidates.front();
  TableLayout layout{separator, lines.front().number, 0, 0, 0, lines[row].number};
  if (candidates.size() > 1) {
    std::size_t const upper = candidates[1];
    bool const only_two_at_the_top = upper == 0 && names == 1 && row == 2;
    Cells const lower(lines[names].text, separator);
    bool const names_in_groups = are_units(lower) && has_groups(lines, upper, separator, first_row.all.size());
    if (names_in_groups || describes(lower, Cells(lines[upper].text, separator), only_two_at_the_top)) {
      layout.units_line = lines[names].number;
      names = upper;
    }
  }
  // numbers above the names are rows of another table: nothing is skipped
  for (std::size_t k = 0; k < names; ++k) {
    Cells const cells(lines[k].text, separator);
    if (cells.is_row() && cells.all.size() == first_row.all.size()) return std::nullopt;
  }
  layout.names_line = lines[names].number;
  if (has_groups(lines, names, separator, first_row.all.size())) layout.groups_line = lines[names - 1].number;
  return layout;
}

}  // namespace torquescope
