// Delimited text, plain or gzip: `#` comment lines, one line of column names, then numbers.
//
// Names      the line right above the rows (table_layout.hpp), a preamble and a line of units apart; else the first
//            line that is no comment, or the comment right above numbers (numpy.savetxt)
// Rows       as many cells as names, and one trailing separator; a last line that was cut short is left out
//            names that repeat are numbered: "Time#1", "Time#2" (repeated_names.hpp)
// Lists      a column of lists in cells is spread into columns "NAME[0]", "NAME[1]", ... (list_cells.hpp)
// Cells      text_column.hpp; a column with text in some cell is unusable, a line of text alone is an error
// Bounds     a line 1 MiB, columns 4096; of gzip see gunzip.hpp
// Errors     Error 65 with file:line

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/digest.hpp"
#include "engine/base/error.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/delimited_text.hpp"
#include "engine/data/file_bytes.hpp"
#include "engine/data/gunzip.hpp"
#include "engine/data/list_cells.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/data/repeated_names.hpp"
#include "engine/data/table_layout.hpp"
#include "engine/data/text_column.hpp"
#include "engine/data/text_encoding.hpp"

namespace torquescope {
namespace {

constexpr std::size_t most_columns = 4096;
constexpr std::size_t longest_line = std::size_t{1} << 20;

bool accepts(std::filesystem::path const&, std::string const& first_bytes) {
  if (is_gzip(first_bytes) || looks_like_utf16(first_bytes)) return true;
  // zeros at the end: a disk that lost power
  std::size_t const end = first_bytes.find_last_not_of('\0') + 1;
  return first_bytes.empty() || (end > 0 && first_bytes.find('\0') >= end);
}

// trailing separators
void drop_empty_end(std::vector<std::string_view>& cells) {
  while (cells.size() > 1 && cells.back().empty()) cells.pop_back();
}

std::vector<std::string> names_of(std::vector<std::string_view> cells) {
  drop_empty_end(cells);
  std::vector<std::string> names;
  for (auto cell : cells) names.push_back(utf8_or_latin1(unquoted(cell)));
  for (std::size_t c = 0; c < names.size(); ++c)
    if (names[c].empty()) names[c] = fmt::format("column {}", c + 1);  // pandas leaves its index without a name
  return names;
}

class CsvText {
 public:
  CsvText(std::string_view text, RawTable& table) : lines_(text), table_(table), layout_(layout_of(text)) {}

  void read() {
    read_names();
    if (layout_) skip_to_rows();
    while (next_line()) add_row();
    drop_empty_rows();
    validate(!table_.line_of_row.empty(), [&] {
      return problem(fmt::format("{} has column names but no rows", table_.path), "was the recording stopped at once?");
    });
    check_marks();
    move_columns();
  }

 private:
  // the next line that is neither empty nor a comment
  bool next_line() {
    while (lines_.next(line_)) {
      validate(line_.size() <= longest_line, [&] {
        return problem(
            fmt::format("line {} has {} bytes; a line may have {}", lines_.line_number(), line_.size(), longest_line),
            "is this one record per line? lines end with LF, CRLF or CR");
      });
      auto const first = line_.find_first_not_of(" \t");
      if (first == std::string_view::npos) continue;
      if (line_[first] != '#') return true;
      last_comment_ = line_.substr(first + 1);
    }
    return false;
  }

  void read_names() {
    validate(next_line(), [&] {
      return bad_data(fmt::format("{} is empty", table_.path), table_.path, 0,
                      "it needs a line of column names, then numbers");
    });
    if (layout_) skip_preamble();
    separator_ = layout_ ? layout_->separator : separator_of(line_);
    marks_.comma_may_be = separator_ != ',';
    split_cells(line_, separator_, cells_);
    bool const names_in_comment = is_numbers() && !comment_names().empty();
    validate(names_in_comment || !is_numbers(), [&] {
      return problem(
          fmt::format("{} has no column names: line {} is numbers already", table_.path, lines_.line_number()),
          "write the names above them, separated like the numbers: t_s,q_rad,tau_Nm");
    });
    table_.names = names_in_comment ? comment_names() : names_of(cells_);
    if (layout_ && layout_->groups_line > 0) take_groups();
    table_.names = with_numbers_of_repeats(std::move(table_.names));
    check_number_of_columns();
    n_cells_ = table_.names.size();
    columns_.resize(table_.names.size());
    if (names_in_comment) add_row();
  }

  void check_number_of_columns() const {
    validate(table_.names.size() <= most_columns, [&] {
      return problem(fmt::format("{} columns; a recording may have {}", table_.names.size(), most_columns),
                     "keep the columns that recording.columns names");
    });
  }

  void take_groups() {
    std::vector<std::string_view> groups;
    split_cells(groups_, separator_, groups);
    table_.names = with_groups(table_.names, groups);
    for (auto& name : table_.names) name = utf8_or_latin1(name);
    table_.remarks.push_back(fmt::format("Line {} was read as groups of the columns: \"{}\" and so on.",
                                         layout_->groups_line, table_.names.front()));
  }

  void skip_preamble() {
    std::int64_t const groups = layout_->groups_line, first = lines_.line_number(),
                       last = (groups > 0 ? groups : layout_->names_line) - 1;
    while (lines_.line_number() < layout_->names_line) {
      if (lines_.line_number() == groups) groups_ = line_;
      next_line();
    }
    if (first > last) return;
    table_.remarks.push_back(first == last
                                 ? fmt::format("Line {} above the column names was skipped.", first)
                                 : fmt::format("Lines {} to {} above the column names were skipped.", first, last));
  }

  // what stands between the names and the rows: units, or words
  void skip_to_rows() {
    LineReader before_row = lines_;
    while (next_line() && lines_.line_number() < layout_->rows_line) {
      before_row = lines_;
      split_cells(line_, separator_, cells_);
      cells_.resize(std::max(cells_.size(), table_.names.size()));
      bool const known =
          std::any_of(cells_.begin(), cells_.end(), [](auto cell) { return is_known_unit(unit_in(cell)); });
      bool const are_units = lines_.line_number() == layout_->units_line && known;
      for (std::size_t c = 0; are_units && c < table_.names.size(); ++c)
        table_.units.push_back(utf8_or_latin1(unit_in(cells_[c])));
      table_.remarks.push_back(are_units
                                   ? fmt::format("Line {} was read as the units of the columns.", lines_.line_number())
                                   : fmt::format("Line {} holds no numbers and was skipped.", lines_.line_number()));
    }
    lines_ = before_row;
  }

  // the last comment as names, if it has as many cells as the line of numbers at hand
  std::vector<std::string> comment_names() const {
    std::vector<std::string_view> cells;
    split_cells(last_comment_, separator_, cells);
    return cells.size() == cells_.size() && !last_comment_.empty() ? names_of(cells) : std::vector<std::string>{};
  }

  bool is_numbers() const {
    DecimalMarks marks = marks_;
    return std::all_of(cells_.begin(), cells_.end(), [&](auto cell) { return TextColumn().add(cell, 1, marks); });
  }

  // what the first row shows
  void spread_lists() {
    lists_.emplace(cells_);
    if (!lists_->any()) return;
    std::size_t const before = table_.names.size();
    table_.names = lists_->spread_names(table_.names);
    table_.units = lists_->spread_units(table_.units);
    check_number_of_columns();
    columns_.resize(table_.names.size());
    table_.remarks.push_back(
        fmt::format("Cells with lists were read as columns: {} for {}.", table_.names.size(), before));
  }

  void add_row() {
    split_cells(line_, separator_, cells_);
    std::size_t const n_columns = n_cells_;
    if (cells_.size() == n_columns + 1 && cells_.back().empty()) cells_.pop_back();
    bool const last = lines_.at_end();
    if (last && cells_.size() < n_columns && !table_.line_of_row.empty()) return leave_out_last_line();
    validate(cells_.size() == n_columns, [&] { return ragged_row(); });
    bool const is_list = !list_elements(cells_.back()).empty();
    if (last && !lines_.line_ended() && !is_list && is_torn(cells_.back())) return leave_out_last_line();
    if (!lists_) spread_lists();
    if (lists_->any()) lists_->spread_cells(cells_);
    std::size_t n_text = 0;
    for (std::size_t c = 0; c < columns_.size(); ++c)
      n_text += !columns_[c].add(cells_[c], lines_.line_number(), marks_);
    validate(n_text < columns_.size(), [&] { return row_of_text(); });
    table_.line_of_row.push_back(lines_.line_number());
    validate(table_.line_of_row.size() * columns_.size() <= most_table_values, [&] {
      return problem(fmt::format("more than {} numbers; one recording may not hold more", most_table_values),
                     "cut it into several recordings: recording.train takes a list");
    });
  }

  // the last cell of a text that does not end its last line: "-", "2.5e-" below numbers
  bool is_torn(std::string_view cell) {
    TextColumn& column = columns_.back();
    bool const was_number = !column.values().empty() && std::isfinite(column.values().back());
    if (!was_number || column.text_line() != 0) return false;
    TextColumn trial = column.without_values();
    DecimalMarks marks = marks_;
    bool const is_text = !trial.add(cell, lines_.line_number(), marks);
    return is_text || std::isnan(trial.values().back());
  }

  void leave_out_last_line() {
    table_.remarks.push_back(
        fmt::format("The last line, {}, was cut short (\"{}\") and is left out.", lines_.line_number(), shown(line_)));
  }

  // a spreadsheet may write lines of separators below its numbers
  void drop_empty_rows() {
    std::size_t n_dropped = 0;
    auto const empty = [](TextColumn& column) { return std::isnan(column.values().back()) && column.text_line() == 0; };
    while (!table_.line_of_row.empty() && std::all_of(columns_.begin(), columns_.end(), empty)) {
      for (auto& column : columns_) column.drop_last();
      table_.line_of_row.pop_back();
      ++n_dropped;
    }
    if (n_dropped > 0)
      table_.remarks.push_back(fmt::format("{} rows without a number at the end are left out.", n_dropped));
  }

  void check_marks() {
    if (marks_.comma_line == 0) return;
    validate(marks_.point_line == 0, [&] {
      return bad_data(fmt::format("{} in line {} has a decimal comma, a number in line {} a decimal point",
                                  marks_.comma_cell, marks_.comma_line, marks_.point_line),
                      table_.path, std::max(marks_.comma_line, marks_.point_line),
                      "export it with one decimal mark and without marks between thousands");
    });
    table_.remarks.push_back(fmt::format("Decimal commas were read as decimal points (first: {} in line {}).",
                                         marks_.comma_cell, marks_.comma_line));
  }

  Problem problem(std::string what, std::string help) const {
    auto problem = bad_data(std::move(what), table_.path, lines_.line_number(), std::move(help));
    problem.place.column = 1;
    problem.place.line_text = shown(line_);
    return problem;
  }

  Problem ragged_row() const {
    auto const what = fmt::format("line {} has {} cells, the header {}", lines_.line_number(), cells_.size(), n_cells_);
    bool const decimal_comma = separator_ == ',' && cells_.size() > n_cells_;
    return problem(what, decimal_comma ? "a decimal comma? write 1.5 for 1,5, or separate the cells by semicolons"
                                       : "was the line cut short? delete it, or cut the recording there");
  }

  Problem row_of_text() const {
    if (with_numbers_of_repeats(names_of(cells_)) == table_.names)
      return problem(fmt::format("the header is repeated in line {}", lines_.line_number()),
                     fmt::format("two recordings in one file? split it at line {}", lines_.line_number()));
    return problem(fmt::format("\"{}\" in line {} is not a number", shown(cells_.front()), lines_.line_number()),
                   "put `#` before lines that are comments");
  }

  void move_columns() {
    auto const names = std::move(table_.names);
    auto const units = std::move(table_.units);
    table_.names.clear();
    table_.units.clear();
    for (std::size_t c = 0; c < names.size(); ++c) {
      TextColumn& column = columns_[c];
      if (column.text_line() != 0) {
        table_.unusable.push_back({names[c],
                                   fmt::format("holds text: \"{}\" in line {}", column.text(), column.text_line()),
                                   column.text_line()});
        continue;
      }
      if (column.stamps() != StampKind::none)
        table_.remarks.push_back(fmt::format("\"{}\" holds {}.", names[c],
                                             column.stamps() == StampKind::date
                                                 ? "dates with times: read as seconds since 1970"
                                                 : "times of day: read as seconds since midnight"));
      table_.names.push_back(names[c]);
      table_.columns.push_back(std::move(column.values()));
      if (!units.empty()) table_.units.push_back(units[c]);
    }
  }

  LineReader lines_;
  RawTable& table_;
  std::optional<TableLayout> layout_;
  std::string_view line_;
  std::string_view last_comment_;
  std::string_view groups_;
  char separator_ = ',';
  DecimalMarks marks_;
  std::vector<std::string_view> cells_;
  std::size_t n_cells_ = 0;  // of a line
  std::optional<ListColumns> lists_{};
  std::vector<TextColumn> columns_;
};

// before a gigabyte of nothing is read and hashed
void refuse_unwritten(std::filesystem::path const& path) {
  constexpr std::size_t most_zeros = std::size_t{64} << 20;  // space that a logger reserves ahead
  auto const end = read_last_bytes(path, most_zeros);
  validate(end.size() < most_zeros || end.find_last_not_of('\0') != std::string::npos, [&] {
    return bad_data(fmt::format("{} ends in {} MiB of zero bytes or more: space that was never written", path.string(),
                                most_zeros >> 20),
                    path.string(), 0,
                    fmt::format("keep the text alone: tr -d '\\0' < {} > written.csv", path.string()));
  });
}

RawTable read(std::filesystem::path const& path) {
  refuse_unwritten(path);
  std::string bytes = read_whole_file(path);
  RawTable table;
  table.path = path.string();
  table.sha256 = sha256_hex(bytes);
  if (is_gzip(bytes)) bytes = gunzip_text(bytes, table.path);
  std::string const text = utf8_text(std::move(bytes), table.path, table.remarks);
  CsvText(text, table).read();
  return table;
}

}  // namespace

ReaderChoice csv_reader() {
  return {"csv", "text separated by comma, semicolon, tab or blanks, plain or gzip; first line: column names", accepts,
          read};
}

}  // namespace torquescope
