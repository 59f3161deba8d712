#include "engine/experiment/recording_manifest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "engine/data/data_problem.hpp"
#include "engine/data/delimited_text.hpp"
#include "engine/data/file_bytes.hpp"
#include "engine/data/text_encoding.hpp"

namespace torquescope {
namespace {

constexpr std::uint64_t largest_manifest_bytes = std::uint64_t{16} << 20;
constexpr int most_problems = 10;  // of one manifest: more are of the same kind

// a cell with the place where a person finds it
struct ManifestCell {
  std::string text;
  SourcePlace place;
};
using ManifestCells = std::vector<ManifestCell>;

// rows of cells to rows of quantities; one problem for each cell that is wrong
class ManifestReader {
 public:
  ManifestReader(std::filesystem::path const& path, std::vector<Problem>& problems)
      : path_(path.string()), problems_(problems) {}

  RecordingManifest read(std::string const& text) {
    split(text);
    if (header_.empty() || rows_.empty()) {
      add(path_ + (header_.empty() ? " is empty" : " names no recording: it has a header and no rows"),
          "write a header, as file,role,mass_kg, and below it one line for each recording");
      return {};
    }
    RecordingManifest manifest;
    manifest.header = header_.front().place;
    manifest.header.length = 0;
    if (!check_header() || !check_lengths()) return manifest;
    for (auto const& row : rows_) {
      manifest.rows.emplace_back();
      manifest.rows.back().place = row.front().place;
    }
    for (std::size_t c = 0; c < header_.size(); ++c) read_column(c, manifest);
    return manifest;
  }

 private:
  void split(std::string const& text) {
    LineReader lines(text);
    std::vector<std::string_view> cells;
    char separator = ',';
    for (std::string_view line; lines.next(line);) {
      if (line.find_first_not_of(" \t,;") == std::string_view::npos) continue;
      bool const is_header = header_.empty();
      if (is_header && separator_of(line) != blanks) separator = separator_of(line);
      split_cells(line, separator, cells);
      ManifestCells row;
      for (auto const cell : cells) {
        // an empty cell does not say where it stands
        int const column = cell.empty() ? 0 : static_cast<int>(cell.data() - line.data()) + 1;
        row.push_back({unquoted(cell),
                       {path_, static_cast<int>(lines.line_number()), column,
                        std::max(1, static_cast<int>(cell.size())), std::string(line)}});
      }
      if (is_header)
        header_ = std::move(row);
      else
        rows_.push_back(std::move(row));
    }
    has_comma_marks_ = separator != ',';
  }

  bool check_header() {
    std::set<std::string> seen;
    std::vector<std::string> names;
    for (auto const& cell : header_) {
      names.push_back(cell.text);
      if (cell.text.empty())
        add(fmt::format("a column of {} has no name", path_), "name it, or remove it", cell.place);
      else if (!seen.insert(cell.text).second)
        add(fmt::format("two columns are called \"{}\"", cell.text), "rename one of them", cell.place);
    }
    if (!seen.contains("file")) {
      add(fmt::format("{} has no column \"file\"", path_), "call the column with the names of the recordings \"file\"",
          header_.front().place, {fmt::format("its columns: {}", fmt::join(names, ", "))});
    }
    return n_problems_ == 0;
  }

  bool check_lengths() {
    for (auto const& row : rows_)
      if (row.size() != header_.size())
        add(fmt::format("line {} has {} cells, and the header has {}", row.front().place.line, row.size(),
                        header_.size()),
            "leave a cell empty where a quantity is not known; put text with a separator in quotes", row.front().place);
    return n_problems_ == 0;
  }

  void read_column(std::size_t c, RecordingManifest& manifest) {
    std::string const& name = header_[c].text;
    if (name == "file" || name == "role") {
      for (std::size_t i = 0; i < rows_.size(); ++i)
        name == "file" ? read_file(rows_[i][c], manifest.rows[i]) : read_role(rows_[i][c], manifest.rows[i]);
      return;
    }
    manifest.quantities.push_back(name);
    std::vector<double> values(rows_.size());
    std::vector<CellKind> kinds;
    for (std::size_t i = 0; i < rows_.size(); ++i) kinds.push_back(kind_of(rows_[i][c].text, values[i]));
    auto const n_numbers = std::count(kinds.begin(), kinds.end(), CellKind::number);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      auto const& cell = rows_[i][c];
      if (kinds[i] == CellKind::number && std::isfinite(values[i]))
        manifest.rows[i].numbers[name] = values[i];
      else if (kinds[i] == CellKind::text && n_numbers == 0)
        manifest.rows[i].words[name] = cell.text;
      else if (kinds[i] != CellKind::missing)
        add(fmt::format("\"{}\" in column {} is no number, and others of the column are", shown(cell.text), name),
            "write a number, or nothing where it is not known; or text in every row", cell.place);
    }
  }

  CellKind kind_of(std::string const& cell, double& value) const {
    CellKind const kind = read_cell(cell, value);
    return kind == CellKind::text && has_comma_marks_ ? read_comma_cell(cell, value) : kind;
  }

  void read_file(ManifestCell const& cell, ManifestRow& row) {
    row.file = cell.text;
    row.place = cell.place;
    if (cell.text.empty()) add(fmt::format("line {} names no file", cell.place.line), "write one", cell.place);
  }

  void read_role(ManifestCell const& cell, ManifestRow& row) {
    if (cell.text == "train" || cell.text == "validate" || cell.text.empty()) {
      row.role = cell.text;
      return;
    }
    add(fmt::format("role \"{}\" is not known", shown(cell.text)), "write train or validate, or nothing", cell.place);
  }

  void add(std::string what, std::string help, SourcePlace place = {}, std::vector<std::string> notes = {}) {
    Problem problem = bad_data(std::move(what), path_, 0, std::move(help));
    if (place.line > 0) problem.place = std::move(place);
    problem.key = "recordings.manifest";
    problem.notes = std::move(notes);
    if (n_problems_++ < most_problems) problems_.push_back(std::move(problem));
  }

  std::string path_;
  std::vector<Problem>& problems_;
  ManifestCells header_;
  std::vector<ManifestCells> rows_;
  bool has_comma_marks_ = false;  // 0,25 can be a number
  int n_problems_ = 0;
};

}  // namespace

RecordingManifest read_manifest(std::filesystem::path const& path, std::vector<Problem>& problems) {
  try {
    std::vector<std::string> remarks;
    auto const text = utf8_text(read_whole_file(path, largest_manifest_bytes), path.string(), remarks);
    return ManifestReader(path, problems).read(text);
  } catch (Error const& error) {
    problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    return {};
  }
}

}  // namespace torquescope
