#include "engine/data/text_column.hpp"

#include <limits>

#include "engine/data/delimited_text.hpp"

namespace torquescope {

namespace {

CellKind read_number(std::string_view cell, std::int64_t line, DecimalMarks& marks, double& value) {
  CellKind kind = read_cell(cell, value);
  bool const quoted = cell.starts_with('"');
  if (!marks.comma_may_be && !quoted) return kind;
  if (kind == CellKind::number && marks.point_line == 0 && cell.find('.') != std::string_view::npos)
    marks.point_line = line;
  if (kind != CellKind::text) return kind;
  kind = read_comma_cell(cell, value);
  if (kind == CellKind::number && marks.comma_line == 0) {
    marks.comma_line = line;
    marks.comma_cell = shown(cell);
  }
  return kind;
}

}  // namespace

bool TextColumn::add(std::string_view cell, std::int64_t line, DecimalMarks& marks) {
  double value = 0.0;
  CellKind const kind = read_number(cell, line, marks, value);
  bool const number_fits = kind == CellKind::missing || (kind == CellKind::number && stamps_ == StampKind::none);
  has_numbers_ = has_numbers_ || (kind == CellKind::number && number_fits);
  if (number_fits) values_.push_back(value);
  if (number_fits || (!has_numbers_ && text_line_ == 0 && add_stamp(cell))) return true;
  values_.push_back(std::numeric_limits<double>::quiet_NaN());
  if (text_line_ == 0) {
    text_line_ = line;
    text_ = shown(cell);
  }
  return false;
}

TextColumn TextColumn::without_values() const {
  TextColumn other;
  other.has_numbers_ = has_numbers_;
  other.stamps_ = stamps_;
  other.days_ = days_;
  other.last_clock_ = last_clock_;
  return other;
}

bool TextColumn::add_stamp(std::string_view cell) {
  double seconds = 0.0;
  StampKind const kind = read_stamp(unquoted(cell), seconds);
  if (kind == StampKind::none || (stamps_ != StampKind::none && kind != stamps_)) return false;
  if (kind == StampKind::clock) {
    bool const past_midnight = stamps_ == StampKind::clock && seconds < last_clock_ - seconds_of_day / 2;
    if (past_midnight) days_ += seconds_of_day;
    last_clock_ = seconds;
    seconds += days_;
  }
  stamps_ = kind;
  values_.push_back(seconds);
  return true;
}

}  // namespace torquescope
