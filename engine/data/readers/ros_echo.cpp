// What `ros2 topic echo --csv` prints of a topic whose messages have a header: rows without a line of names.
//
// Row        sec, nanosec, frame_id, then the message's fields; lists are spread, an empty one is an empty cell.
//            sensor_msgs/JointState: n names, then n positions, velocities and efforts, or an empty cell each;
//            control_msgs/JointTrajectoryControllerState: n names, then points of four such lists, sec, nanosec
// Names      "stamp.sec", "stamp.nanosec", "joint/position", ...; of a controller "joint/feedback.position", ...; of
//            others "frame_id", "value[0]", ... Rows of other joints and notes of ros2 are left out, and told
// Errors     Error 65 with file:line
// Source     rosidl_runtime_py/convert.py (message_to_csv); the .msg files: points are desired, actual, error in old
//            versions, reference, feedback, error, output in new ones

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/digest.hpp"
#include "engine/base/error.hpp"
#include "engine/data/data_problem.hpp"
#include "engine/data/delimited_text.hpp"
#include "engine/data/file_bytes.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/data/text_column.hpp"
#include "engine/data/text_encoding.hpp"

namespace torquescope {
namespace {

using Cells = std::vector<std::string_view>;

constexpr std::size_t n_header = 3;  // sec, nanosec, frame_id
constexpr std::array channels{"position", "velocity", "effort"};
// of a controller's state, by their places: the newer names
constexpr std::array points{"reference", "feedback", "error", "output"};
constexpr std::array fields_of_point{"position", "velocity", "acceleration", "effort"};
constexpr std::size_t most_columns = 4096;
constexpr std::size_t longest_line = std::size_t{1} << 20;

bool is_whole(std::string_view cell, double most) {
  double value = 0.0;
  return !cell.empty() && cell.find_first_not_of("0123456789") == std::string_view::npos &&
         read_cell(cell, value) == CellKind::number && value <= most;
}

bool is_text(std::string_view cell) {
  double value = 0.0;
  return !cell.empty() && read_cell(cell, value) == CellKind::text;
}

bool has_stamp(Cells const& cells) {
  constexpr double most_seconds = 4294967295.0, most_nanoseconds = 999999999.0;
  return cells.size() > n_header && is_whole(cells[0], most_seconds) && is_whole(cells[1], most_nanoseconds) &&
         (cells[2].empty() || is_text(cells[2]));
}

// ros2 prints these between messages, to the same stream
bool is_notice(std::string_view line) {
  return line.front() == '\t' || line.starts_with("A message was lost") || line.starts_with("WARNING");
}

// by its first message: where a table has names, this has a number
bool accepts(std::filesystem::path const&, std::string const& first_bytes) {
  LineReader lines(first_bytes);
  Cells cells;
  for (std::string_view line; lines.next(line);) {
    if (line.empty() || is_notice(line)) continue;
    split_cells(line, ',', cells);
    return has_stamp(cells);
  }
  return false;
}

// `count` lists of n numbers, or an empty cell each (NaN), from `at` on, which moves behind them; nothing: no lists
std::optional<std::vector<double>> lists_of(Cells const& cells, std::size_t n, std::size_t count, std::size_t& at) {
  std::vector<double> values;
  for (std::size_t c = 0; c < count; ++c) {
    if (at >= cells.size()) return std::nullopt;
    bool const is_missing = cells[at].empty();
    for (std::size_t j = 0; j < n; ++j) {
      values.push_back(std::numeric_limits<double>::quiet_NaN());
      if (is_missing) continue;
      if (at >= cells.size() || cells[at].empty()) return std::nullopt;
      if (read_cell(cells[at++], values.back()) == CellKind::text) return std::nullopt;
    }
    at += is_missing;
  }
  return values;
}

// of a row of sensor_msgs/JointState: position, velocity and effort of n joints; nothing: it is none
std::optional<std::vector<double>> state_numbers(Cells const& cells, std::size_t n) {
  std::size_t at = n_header + n;
  auto values = lists_of(cells, n, channels.size(), at);
  return values && at == cells.size() ? std::move(values) : std::nullopt;
}

// of a row of a controller's state: as many points as there are, then whatever comes; nothing: fewer than three
std::optional<std::vector<double>> controller_numbers(Cells const& cells, std::size_t n) {
  std::size_t at = n_header + n, n_found = 0;
  std::vector<double> values;
  for (; n_found < points.size(); ++n_found) {
    std::size_t next = at;
    auto const point = lists_of(cells, n, fields_of_point.size(), next);
    double time = 0.0;
    bool const has_time = point && next + 1 < cells.size() && read_cell(cells[next], time) == CellKind::number &&
                          read_cell(cells[next + 1], time) == CellKind::number;
    if (!has_time) break;
    values.insert(values.end(), point->begin(), point->end());
    at = next + 2;
  }
  constexpr std::size_t fewest = 3;  // a trajectory's point, alone, has one
  if (n_found < fewest) return std::nullopt;
  values.resize(points.size() * fields_of_point.size() * n, std::numeric_limits<double>::quiet_NaN());
  return values;
}

std::size_t n_names(Cells const& cells) {
  auto const begin = cells.begin() + n_header;
  return static_cast<std::size_t>(std::find_if_not(begin, cells.end(), is_text) - begin);
}

class Echo {
 public:
  Echo(std::string_view text, RawTable& table) : lines_(text), table_(table) {}

  void read() {
    Cells cells;
    for (std::string_view line; lines_.next(line);) {
      validate(line.size() <= longest_line, [&] { return problem(line, "a line may not be longer than 1 MiB"); });
      if (line.empty()) continue;
      if (is_notice(line)) {
        note(n_notices_, first_notice_);
        continue;
      }
      split_cells(line, ',', cells);
      bool const is_cut = lines_.at_end() && !lines_.line_ended();
      if (columns_.empty()) begin(line, cells);
      if (add(cells)) continue;
      if (is_cut) {
        table_.remarks.push_back(
            fmt::format("The last line, {}, was cut short and is left out.", lines_.line_number()));
        break;
      }
      throw Error(problem(line, "echo one topic to a file: ros2 topic echo --csv --full-length TOPIC > topic.csv"));
    }
    finish();
  }

 private:
  void note(std::size_t& count, std::int64_t& first) const {
    if (count++ == 0) first = lines_.line_number();
  }

  Problem problem(std::string_view line, std::string help) const {
    auto problem = bad_data(fmt::format("line {} is no message like those before it", lines_.line_number()),
                            table_.path, lines_.line_number(), std::move(help));
    problem.place.column = 1;
    problem.place.line_text = shown(line);
    return problem;
  }

  void begin(std::string_view line, Cells const& cells) {
    validate(has_stamp(cells) && cells.size() <= most_columns,
             [&] { return problem(line, "a row has sec, nanosec, frame_id, and at most 4096 cells"); });
    table_.names = {"stamp.sec", "stamp.nanosec"};
    std::size_t const n = n_names(cells);
    is_controller_ = n > 0 && !state_numbers(cells, n) && controller_numbers(cells, n);
    if (n > 0 && (is_controller_ || state_numbers(cells, n))) {
      for (std::size_t j = 0; j < n; ++j) joints_.emplace_back(cells[n_header + j]);
      for (auto const& channel : channel_names())
        for (auto const& joint : joints_) table_.names.push_back(utf8_or_latin1(joint) + "/" + channel);
    } else {
      table_.names.emplace_back("frame_id");
      for (std::size_t k = n_header; k < cells.size(); ++k)
        table_.names.push_back(fmt::format("value[{}]", k - n_header));
    }
    columns_.resize(table_.names.size());
  }

  std::vector<std::string> channel_names() const {
    if (!is_controller_) return {channels.begin(), channels.end()};
    std::vector<std::string> names;
    for (auto const* point : points)
      for (auto const* field : fields_of_point) names.push_back(fmt::format("{}.{}", point, field));
    return names;
  }

  // false: it is no such message
  bool add(Cells const& cells) {
    if (!has_stamp(cells)) return false;
    validate((table_.line_of_row.size() + 1) * columns_.size() <= most_table_values, [&] {
      return problem("", fmt::format("more than {} numbers: cut it into several recordings", most_table_values));
    });
    if (!joints_.empty()) return add_joints(cells);
    if (cells.size() != columns_.size()) return false;
    for (std::size_t c = 0; c < cells.size(); ++c) columns_[c].add(cells[c], lines_.line_number(), marks_);
    table_.line_of_row.push_back(lines_.line_number());
    return true;
  }

  bool add_joints(Cells const& cells) {
    auto const n = n_names(cells);
    auto const numbers = is_controller_ ? controller_numbers(cells, n) : state_numbers(cells, n);
    if (!numbers) return false;
    auto const names = cells.begin() + n_header;
    if (!std::equal(joints_.begin(), joints_.end(), names, names + static_cast<std::ptrdiff_t>(n))) {
      note(n_others_, first_other_);
      return true;
    }
    for (std::size_t c = 0; c < 2; ++c) columns_[c].add(cells[c], lines_.line_number(), marks_);
    for (std::size_t k = 0; k < numbers->size(); ++k) columns_[k + 2].values().push_back((*numbers)[k]);
    table_.line_of_row.push_back(lines_.line_number());
    return true;
  }

  void finish() {
    if (n_others_ > 0)
      table_.remarks.push_back(fmt::format(
          "Messages of other joints were left out: {}, the first in line {}. Write each topic to a file of its own.",
          n_others_, first_other_));
    if (n_notices_ > 0)
      table_.remarks.push_back(
          fmt::format("Lines that are no message were left out: {}, the first is line {}.", n_notices_, first_notice_));
    auto const names = std::move(table_.names);
    table_.names.clear();
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      auto& column = columns_[c];
      auto const& values = column.values();
      if (column.text_line() != 0)
        table_.unusable.push_back({names[c],
                                   fmt::format("holds text: \"{}\" in line {}", column.text(), column.text_line()),
                                   column.text_line()});
      else if (std::all_of(values.begin(), values.end(), [](double value) { return std::isnan(value); }))
        table_.unusable.push_back({names[c], "is empty in every message"});
      else {
        table_.names.push_back(names[c]);
        table_.columns.push_back(std::move(column.values()));
      }
    }
  }

  LineReader lines_;
  RawTable& table_;
  std::vector<std::string> joints_;  // as the file writes them; none: another message
  bool is_controller_ = false;
  std::vector<TextColumn> columns_;
  DecimalMarks marks_;
  std::size_t n_others_ = 0, n_notices_ = 0;
  std::int64_t first_other_ = 0, first_notice_ = 0;
};

RawTable read(std::filesystem::path const& path) {
  std::string bytes = read_whole_file(path);
  RawTable table;
  table.path = path.string();
  table.sha256 = sha256_hex(bytes);
  std::string const text = utf8_text(std::move(bytes), table.path, table.remarks);
  Echo(text, table).read();
  validate(!table.columns.empty(), [&] {
    return bad_data(fmt::format("{} holds no messages", table.path), table.path, 0, "was the echo stopped at once?");
  });
  return table;
}

}  // namespace

ReaderChoice ros_echo_reader() {
  return {"ros_echo", "rows of ros2 topic echo --csv: sec, nanosec, frame_id, then the message; joints by name",
          accepts, read};
}

}  // namespace torquescope
