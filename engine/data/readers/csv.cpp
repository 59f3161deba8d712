// Delimited text, plain or gzip: `#` comment lines, one line of column names, then numbers.
//
// Names      the first line that is no comment; if that is numbers already, the comment line right before it
//            (numpy.savetxt writes them so)
// Rows       as many cells as names; one trailing separator is allowed; empty lines do not count
// Text       a column with text in some cell becomes unusable, with its first line; a line of text only (a repeated
//            header) is an error
// Bounds     a line 1 MiB, columns 4096; of gzip see gunzip.hpp
// Errors     Error 65 with file:line

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/digest.hpp"
#include "engine/base/error.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/delimited_text.hpp"
#include "engine/data/file_bytes.hpp"
#include "engine/data/gunzip.hpp"
#include "engine/data/recording_reader.hpp"

namespace torquescope {
namespace {

constexpr std::size_t most_columns = 4096;
constexpr std::size_t longest_line = std::size_t{1} << 20;

bool accepts(std::filesystem::path const&, std::string const& first_bytes) {
  bool const utf16 = first_bytes.starts_with("\xff\xfe") || first_bytes.starts_with("\xfe\xff");  // said in read()
  return is_gzip(first_bytes) || utf16 || first_bytes.find('\0') == std::string::npos;
}

class CsvText {
 public:
  CsvText(std::string_view text, RawTable& table) : lines_(text), table_(table) {}

  void read() {
    read_names();
    while (next_line()) add_row();
    validate(!table_.line_of_row.empty(), [&] {
      return problem(fmt::format("{} has column names but no rows", table_.path), "was the recording stopped at once?");
    });
    move_text_columns();
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
    separator_ = separator_of(line_);
    split_cells(line_, separator_, cells_);
    bool const names_in_comment = is_numbers() && !comment_names().empty();
    validate(names_in_comment || !is_numbers(), [&] {
      return problem(
          fmt::format("{} has no column names: line {} is numbers already", table_.path, lines_.line_number()),
          "write the names above them, separated like the numbers: t_s,q_rad,tau_Nm");
    });
    table_.names = names_in_comment ? comment_names() : names_of(cells_);
    validate(table_.names.size() <= most_columns, [&] {
      return problem(fmt::format("{} columns; a recording may have {}", table_.names.size(), most_columns),
                     "keep the columns that recording.columns names");
    });
    table_.columns.resize(table_.names.size());
    first_text_.resize(table_.names.size());
    if (names_in_comment) add_row();
  }

  static std::vector<std::string> names_of(std::vector<std::string_view> cells) {
    while (cells.size() > 1 && cells.back().empty()) cells.pop_back();  // trailing separators
    std::vector<std::string> names;
    for (auto cell : cells) names.push_back(unquoted(cell));
    for (std::size_t c = 0; c < names.size(); ++c)
      if (names[c].empty()) names[c] = fmt::format("column {}", c + 1);  // pandas leaves its index without a name
    return names;
  }

  // the last comment as names, if it has as many cells as the line of numbers at hand
  std::vector<std::string> comment_names() const {
    std::vector<std::string_view> cells;
    split_cells(last_comment_, separator_, cells);
    return cells.size() == cells_.size() && !last_comment_.empty() ? names_of(cells) : std::vector<std::string>{};
  }

  bool is_numbers() const {
    double ignored = 0.0;
    return std::none_of(cells_.begin(), cells_.end(),
                        [&](auto cell) { return read_cell(cell, ignored) == CellKind::text; });
  }

  void add_row() {
    split_cells(line_, separator_, cells_);
    std::size_t const n_columns = table_.names.size();
    if (cells_.size() == n_columns + 1 && cells_.back().empty()) cells_.pop_back();
    validate(cells_.size() == n_columns, [&] { return ragged_row(); });
    std::size_t n_text = 0;
    for (std::size_t c = 0; c < n_columns; ++c) {
      double value = 0.0;
      bool const is_text = read_cell(cells_[c], value) == CellKind::text;
      n_text += is_text;
      if (is_text && first_text_[c].line == 0)
        first_text_[c] = {table_.names[c],
                          fmt::format("holds text: \"{}\" in line {}", shown(cells_[c]), lines_.line_number()),
                          lines_.line_number()};
      table_.columns[c].push_back(value);
    }
    validate(n_text < n_columns, [&] { return row_of_text(); });
    table_.line_of_row.push_back(lines_.line_number());
    validate(table_.line_of_row.size() * n_columns <= most_table_values, [&] {
      return problem(fmt::format("more than {} numbers; one recording may not hold more", most_table_values),
                     "cut it into several recordings: recording.train takes a list");
    });
  }

  Problem problem(std::string what, std::string help) const {
    auto problem = bad_data(std::move(what), table_.path, lines_.line_number(), std::move(help));
    problem.place.column = 1;
    problem.place.line_text = shown(line_);
    return problem;
  }

  Problem ragged_row() const {
    auto const what =
        fmt::format("line {} has {} cells, the header {}", lines_.line_number(), cells_.size(), table_.names.size());
    bool const decimal_comma = separator_ == ',' && cells_.size() > table_.names.size();
    return problem(what, decimal_comma ? "a decimal comma? write 1.5 for 1,5, or separate the cells by semicolons"
                                       : "was the line cut short? delete it, or cut the recording there");
  }

  Problem row_of_text() const {
    bool const header = names_of(cells_) == table_.names;
    if (header)
      return problem(fmt::format("the header is repeated in line {}", lines_.line_number()),
                     fmt::format("two recordings in one file? split it at line {}", lines_.line_number()));
    bool const decimal_comma = separator_ != ',' && line_.find(',') != std::string_view::npos;
    return problem(fmt::format("\"{}\" in line {} is not a number", shown(cells_.front()), lines_.line_number()),
                   decimal_comma ? "a decimal comma? write 1.5 for 1,5" : "put `#` before lines that are comments");
  }

  void move_text_columns() {
    RawTable kept{table_.path, table_.sha256, {}, {}, std::move(table_.line_of_row)};
    for (std::size_t c = 0; c < table_.names.size(); ++c) {
      if (first_text_[c].line != 0) {
        kept.unusable.push_back(std::move(first_text_[c]));
      } else {
        kept.names.push_back(std::move(table_.names[c]));
        kept.columns.push_back(std::move(table_.columns[c]));
      }
    }
    table_ = std::move(kept);
  }

  LineReader lines_;
  RawTable& table_;
  std::string_view line_;
  std::string_view last_comment_;
  char separator_ = ',';
  std::vector<std::string_view> cells_;
  std::vector<UnusableColumn> first_text_;  // line 0: none so far
};

RawTable read(std::filesystem::path const& path) {
  std::string bytes = read_whole_file(path);
  RawTable table;
  table.path = path.string();
  table.sha256 = sha256_hex(bytes);
  if (is_gzip(bytes)) bytes = gunzip_text(bytes, table.path);
  std::string_view text = bytes;
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // byte order mark of UTF-8
  bool const utf16 = text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
  bool const binary = text.find('\0') != std::string_view::npos;
  validate(!utf16 && !binary, [&] {
    return bad_data(
        fmt::format("{} is {}", table.path, utf16 ? "UTF-16 text" : "not text throughout: it holds zero bytes"),
        table.path, 0,
        utf16 ? "save it as UTF-8 (iconv -f UTF-16 -t UTF-8)" : "copy it again, or export it again as CSV");
  });
  CsvText(text, table).read();
  return table;
}

}  // namespace

ReaderChoice csv_reader() {
  return {"csv", "text separated by comma, semicolon, tab or blanks, plain or gzip; first line: column names", accepts,
          read};
}

}  // namespace torquescope
