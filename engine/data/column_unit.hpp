#pragma once
// What a unit in a column's name means: "[ms]", "deg", "Inc", "mA".
//
// SI value   of one unit, when the unit alone tells it; 0 when it depends on the drive: encoder counts, amperes, volts,
//            shares of the rated torque
// Threads    functions of their arguments

#include <optional>
#include <string>
#include <string_view>

namespace torquescope {

enum class UnitKind { time, angle, length, counts, angular_speed, linear_speed, acceleration, torque, force, drive };

struct ColumnUnit {
  UnitKind kind = UnitKind::time;
  double si = 0.0;             // s, rad, m, rad/s, m/s, N m or N of one unit; 0: unknown
  std::string_view meaning{};  // "degrees", "encoder counts", "a current in A"
};

// `word` in lower case; nothing when it is no unit
std::optional<ColumnUnit> column_unit(std::string_view word);

// one letter: a unit only at the end of a name ("i_A"), for "a" or "s" alone is a name
bool is_short_unit(std::string_view word);

}  // namespace torquescope
