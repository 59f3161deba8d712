#pragma once
// What each column of a table looks like by its values alone, for a person who has to say which is which.
//
// Clock      runs forwards in every row. Smooth: a position changes little from row to row beside its range
// Derivative the column whose slope over a twentieth of a period is most like it, without their means
// Torque     least squares of the column on slope, bend and sign of the slope of a smooth one, and a constant
// Units      of the file; slopes a row
// Threads    free function

#include <string>
#include <vector>

#include "engine/data/recording_reader.hpp"

namespace torquescope {

enum class Look { constant, clock, two_values, position, derivative, torque, like_none };

struct ColumnLook {
  std::string column;
  Look look = Look::like_none;
  double least = 0.0, most = 0.0;
  double step = 0.0;      // median change from row to row, of rows that change
  std::string of{};       // derivative: of that position; torque: beside that one
  double likeness = 0.0;  // derivative: correlation; torque: share of the variance that the motion explains
};

// of the first columns of the table, a few dozen at most
std::vector<ColumnLook> column_looks(RawTable const& table);

}  // namespace torquescope
