// JSON: a list of records, one record a line, or an object of columns; nested objects and lists become names.
//
// Rows       the outermost list counts them (of "one record a line" the lines), or an object with keys "0", "1", ... of
//            pandas. What stands outside of every list is no column
// Names      keys joined by '/', elements of further lists with [k]: {"joint": {"q": [1, 2]}} has joint/q[0], [1]
// Values     numbers, true and false as 1 and 0, null and Python's NaN as missing, texts that are numbers or stamps
// Bounds     depth 64, columns 4096, numbers of a recording; the text is parsed as a stream, nothing is kept of it
// Errors     Error 65 with file:line; a last line that was cut short is left out
// Source     RFC 8259; jsonlines.org

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "engine/base/digest.hpp"
#include "engine/base/error.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/delimited_text.hpp"
#include "engine/data/file_bytes.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/data/table_builder.hpp"
#include "engine/data/text_encoding.hpp"
#include "engine/data/time_stamp.hpp"

namespace torquescope {
namespace {

constexpr std::size_t deepest = 64, most_columns = 4096, shown_bytes = 200;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

std::string_view without_blanks(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  auto const first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

bool accepts(std::filesystem::path const&, std::string const& first_bytes) {
  auto const text = without_blanks(first_bytes);
  if (text.starts_with('{')) return text.find("\":") != text.npos || text.find("\" :") != text.npos;
  if (!text.starts_with('[')) return false;
  auto const inner = without_blanks(text.substr(1));
  return inner.starts_with('{') || inner.starts_with('[');
}

// Python writes NaN and Infinity, which JSON does not know: empty texts of the same length
void blank_not_numbers(std::string& text) {
  auto const blanked = [&](std::size_t at) -> std::size_t {
    for (std::string_view const word : {"NaN", "Infinity", "-Infinity"})
      if (text.compare(at, word.size(), word) == 0) {
        text.replace(at, word.size(), "\"\"" + std::string(word.size() - 2, ' '));
        return word.size();
      }
    return 1;
  };
  bool in_text = false;
  for (std::size_t i = 0; i < text.size();) {
    char const letter = text[i];
    if (letter == '"') in_text = !in_text;
    if (in_text && letter == '\\')
      i += 2;
    else
      i += !in_text && (letter == 'N' || letter == 'I' || letter == '-') ? blanked(i) : 1;
  }
}

struct JsonColumn {
  std::vector<double> values{};
  std::string text{};  // the first that is no number
  std::size_t text_row = 0;
};

// what nlohmann's parser meets, in order; `false` from a member would end it
class JsonRows final : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit JsonRows(std::string const& path) : file_(path) {}

  // the documents that follow are rows themselves
  void begin_row(std::size_t row) {
    row_ = row;
    lines_are_rows_ = true;
  }

  bool null() override { return leaf(nothing); }
  bool boolean(bool value) override { return leaf(value ? 1.0 : 0.0); }
  bool number_integer(number_integer_t value) override { return leaf(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return leaf(static_cast<double>(value)); }
  bool number_float(number_float_t value, string_t const&) override { return leaf(value); }
  bool binary(binary_t&) override { return true; }
  bool string(string_t& text) override {
    double value = nothing;
    auto const kind = read_cell(text, value);
    if (kind == CellKind::text && read_stamp(text, value) == StampKind::none) return leaf(nothing, &text);
    return leaf(kind == CellKind::missing ? nothing : value);
  }
  bool start_object(std::size_t) override { return open(false); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    Level& level = levels_.back();
    path_.resize(level.path_size);
    bool const is_index = name == std::to_string(level.next);
    if (level.counts_rows || (is_index && level.next == 0 && !has_rows())) {
      level.counts_rows = true;
      row_ = level.next++;
      return true;
    }
    path_ += (path_.empty() ? "" : "/") + name;
    return true;
  }
  bool parse_error(std::size_t position, std::string const&, nlohmann::json::exception const&) override {
    error_at = position;
    return false;
  }

  std::size_t error_at = 0;  // byte from 1, of the text that was parsed last

  RawTable table(std::string sha256, std::vector<std::int64_t> line_of_row) && {
    TableBuilder builder(file_, std::move(sha256));
    for (auto& name : names_) {
      auto& column = columns_.at(name);
      if (name.empty()) name = "values";
      if (name.front() == '[') name = "values" + name;
      if (!column.text.empty()) {
        builder.cannot_use(name, fmt::format("holds text: \"{}\" in record {}", column.text, column.text_row + 1));
        continue;
      }
      column.values.resize(lines_are_rows_ ? line_of_row.size() : column.values.size(), nothing);
      builder.reserve(column.values.size(), 1, name);
      builder.add(name, std::move(column.values));
    }
    RawTable whole = std::move(builder).finish();
    if (lines_are_rows_) whole.line_of_row = std::move(line_of_row);
    return whole;
  }

 private:
  struct Level {
    bool is_array = false, counts_rows = false;
    std::size_t path_size = 0, next = 0;
  };

  bool has_rows() const {
    return lines_are_rows_ ||
           std::any_of(levels_.begin(), levels_.end(), [](Level const& level) { return level.counts_rows; });
  }

  // the element of a list that follows
  void begin_value() {
    if (levels_.empty() || !levels_.back().is_array) return;
    Level& level = levels_.back();
    path_.resize(level.path_size);
    if (level.counts_rows)
      row_ = level.next++;
    else
      path_ += fmt::format("[{}]", level.next++);
  }

  bool open(bool is_array) {
    begin_value();
    validate(levels_.size() < deepest, [&] {
      return bad_data(fmt::format("{} nests deeper than {} levels", file_, deepest), file_, 0, "export a flat table");
    });
    levels_.push_back({is_array, is_array && !has_rows(), path_.size(), 0});
    return true;
  }

  bool close() {
    path_.resize(levels_.back().path_size);
    levels_.pop_back();
    return true;
  }

  bool leaf(double value, std::string const* text = nullptr) {
    begin_value();
    if (!has_rows()) return true;
    auto const [at, is_new] = columns_.try_emplace(path_);
    if (is_new) names_.push_back(path_);
    auto& column = at->second;
    validate(names_.size() <= most_columns && names_.size() * (row_ + 1) <= most_table_values, [&] {
      return bad_data(
          fmt::format("{} has more than {} columns, or more than {} numbers", file_, most_columns, most_table_values),
          file_, 0, "keep the columns that recording.columns names");
    });
    if (column.values.size() <= row_) column.values.resize(row_ + 1, nothing);
    column.values[row_] = value;
    if (text != nullptr && column.text.empty()) {
      column.text = shown(*text);
      column.text_row = row_;
    }
    return true;
  }

  std::string file_;
  std::vector<Level> levels_{};
  std::string path_{};
  std::size_t row_ = 0;
  bool lines_are_rows_ = false;
  std::vector<std::string> names_{};  // in the order of the file
  std::unordered_map<std::string, JsonColumn> columns_{};
};

Problem torn(std::string const& path, std::int64_t line, std::string_view text) {
  auto problem = bad_data(fmt::format("{} is no JSON from line {} on", path, line), path, line,
                          "was the file cut short? write it again, or as one record a line: then the rest serves");
  problem.place.line_text = shown(text);
  return problem;
}

bool parses(std::string_view text, JsonRows& rows) {
  return nlohmann::json::sax_parse(text.begin(), text.end(), &rows);
}

// a record in the first line, and another one below it
bool is_record_a_line(std::string_view text) {
  LineReader lines(without_blanks(text));
  std::string_view first, second;
  if (!lines.next(first) || !nlohmann::json::accept(first.begin(), first.end())) return false;
  while (lines.next(second))
    if (auto const begin = without_blanks(second); !begin.empty()) return begin.front() == first.front();
  return false;
}

std::vector<std::int64_t> read_lines(std::string_view text, RawTable& said, JsonRows& rows) {
  LineReader lines(text);
  std::vector<std::int64_t> line_of_row;
  for (std::string_view line; lines.next(line);) {
    if (without_blanks(line).empty()) continue;
    rows.begin_row(line_of_row.size());
    bool const is_whole = nlohmann::json::accept(line.begin(), line.end());
    if (!is_whole && lines.at_end() && !line_of_row.empty()) {
      said.remarks.push_back(fmt::format("The last line, {}, was cut short and is left out.", lines.line_number()));
      break;
    }
    validate(is_whole && parses(line, rows), [&] { return torn(said.path, lines.line_number(), line); });
    line_of_row.push_back(lines.line_number());
  }
  return line_of_row;
}

RawTable read(std::filesystem::path const& path) {
  std::string bytes = read_whole_file(path);
  RawTable said;
  said.path = path.string();
  std::string const sha256 = sha256_hex(bytes);
  std::string text = utf8_text(std::move(bytes), said.path, said.remarks);
  blank_not_numbers(text);
  JsonRows rows(said.path);
  std::vector<std::int64_t> line_of_row;
  if (is_record_a_line(text)) {
    line_of_row = read_lines(text, said, rows);
  } else {
    validate(parses(text, rows), [&] {
      std::size_t const at = std::min(rows.error_at, text.size());
      auto const end = text.begin() + static_cast<std::ptrdiff_t>(at);
      auto const begin = text.rfind('\n', at == 0 ? 0 : at - 1);
      return torn(said.path, 1 + std::count(text.begin(), end, '\n'),
                  std::string_view(text).substr(begin == text.npos ? 0 : begin + 1, shown_bytes));
    });
  }
  RawTable table = std::move(rows).table(sha256, std::move(line_of_row));
  table.remarks.insert(table.remarks.begin(), said.remarks.begin(), said.remarks.end());
  return table;
}

}  // namespace

ReaderChoice json_reader() {
  return {"json", "JSON: a list of records, one record a line, or an object of columns; nested keys joined by '/'",
          accepts, read};
}

}  // namespace torquescope
