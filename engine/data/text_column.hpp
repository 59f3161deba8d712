#pragma once
// One column of a delimited text as it is read: numbers, or times in words that become seconds.
//
// Numbers    with a point; with a comma where no comma separates cells
// Times      time_stamp.hpp; clock times go on counting over midnight
// Threads    an object belongs to one thread

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/data/recording_reader.hpp"
#include "engine/data/time_stamp.hpp"

namespace torquescope {

// the first lines that write 0,25 and 0.25; 0: none does
struct DecimalMarks {
  bool comma_may_be = false;
  std::int64_t comma_line = 0, point_line = 0;
  std::string comma_cell{};
};

class TextColumn {
 public:
  // false: the cell is text
  bool add(std::string_view cell, std::int64_t line, DecimalMarks& marks);
  TextColumn without_values() const;  // reads the next cell as this one would
  void drop_last() { values_.pop_back(); }

  std::vector<double>& values() { return values_; }
  StampKind stamps() const { return stamps_; }
  // the first cell that is text; line 0: none is
  std::int64_t text_line() const { return text_line_; }
  std::string const& text() const { return text_; }

 private:
  bool add_stamp(std::string_view cell);

  std::vector<double> values_;
  bool has_numbers_ = false;
  StampKind stamps_ = StampKind::none;
  double days_ = 0.0, last_clock_ = 0.0;  // s
  std::int64_t text_line_ = 0;
  std::string text_;
};

}  // namespace torquescope
