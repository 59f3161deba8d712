#include "engine/data/column_unit.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace torquescope {
namespace column_units {

struct Entry {
  std::string_view word;
  ColumnUnit unit;
};

constexpr double turn = 2 * std::numbers::pi, degree = std::numbers::pi / 180, per_minute = turn / 60;

constexpr ColumnUnit seconds{UnitKind::time, 1.0, "seconds"}, milliseconds{UnitKind::time, 1e-3, "milliseconds"},
    microseconds{UnitKind::time, 1e-6, "microseconds"}, nanoseconds{UnitKind::time, 1e-9, "nanoseconds"},
    radians{UnitKind::angle, 1.0, "rad"}, degrees{UnitKind::angle, degree, "degrees"},
    turns{UnitKind::angle, turn, "turns"}, counts{UnitKind::counts, 0.0, "encoder counts"},
    rad_per_s{UnitKind::angular_speed, 1.0, "rad/s"}, deg_per_s{UnitKind::angular_speed, degree, "degrees per second"},
    rpm{UnitKind::angular_speed, per_minute, "turns per minute"}, m_per_s{UnitKind::linear_speed, 1.0, "m/s"},
    mm_per_s{UnitKind::linear_speed, 1e-3, "mm/s"}, acceleration{UnitKind::acceleration, 1.0, "an acceleration"},
    newton_metres{UnitKind::torque, 1.0, "N m"}, milli_newton_metres{UnitKind::torque, 1e-3, "mN m"},
    amperes{UnitKind::drive, 0.0, "a current in A"}, milliamperes{UnitKind::drive, 0.0, "a current in mA"},
    volts{UnitKind::drive, 0.0, "a voltage in V"}, millivolts{UnitKind::drive, 0.0, "a voltage in mV"},
    percent{UnitKind::drive, 0.0, "percent of the rated value"},
    permille{UnitKind::drive, 0.0, "per mille of the rated value"};

constexpr std::array entries{Entry{"s", seconds},
                             Entry{"sec", seconds},
                             Entry{"secs", seconds},
                             Entry{"second", seconds},
                             Entry{"seconds", seconds},
                             Entry{"ms", milliseconds},
                             Entry{"msec", milliseconds},
                             Entry{"msecs", milliseconds},
                             Entry{"millis", milliseconds},
                             Entry{"milliseconds", milliseconds},
                             Entry{"us", microseconds},
                             Entry{"usec", microseconds},
                             Entry{"usecs", microseconds},
                             Entry{"micros", microseconds},
                             Entry{"microseconds", microseconds},
                             Entry{"\xc2\xb5s", microseconds},
                             Entry{"\xce\xbcs", microseconds},
                             Entry{"ns", nanoseconds},
                             Entry{"nsec", nanoseconds},
                             Entry{"nsecs", nanoseconds},
                             Entry{"nanosec", nanoseconds},
                             Entry{"nanosecs", nanoseconds},
                             Entry{"nanoseconds", nanoseconds},
                             Entry{"rad", radians},
                             Entry{"radians", radians},
                             Entry{"mrad", {UnitKind::angle, 1e-3, "mrad"}},
                             Entry{"deg", degrees},
                             Entry{"degree", degrees},
                             Entry{"degrees", degrees},
                             Entry{"\xc2\xb0", degrees},
                             Entry{"grad", degrees},
                             Entry{"rev", turns},
                             Entry{"revs", turns},
                             Entry{"turn", turns},
                             Entry{"turns", turns},
                             Entry{"m", {UnitKind::length, 1.0, "m"}},
                             Entry{"cm", {UnitKind::length, 1e-2, "cm"}},
                             Entry{"mm", {UnitKind::length, 1e-3, "mm"}},
                             Entry{"um", {UnitKind::length, 1e-6, "micrometres"}},
                             Entry{"\xc2\xb5m", {UnitKind::length, 1e-6, "micrometres"}},
                             Entry{"inc", counts},
                             Entry{"incs", counts},
                             Entry{"increments", counts},
                             Entry{"inkr", counts},
                             Entry{"count", counts},
                             Entry{"counts", counts},
                             Entry{"cnt", counts},
                             Entry{"cnts", counts},
                             Entry{"cts", counts},
                             Entry{"tick", counts},
                             Entry{"ticks", counts},
                             Entry{"lsb", counts},
                             Entry{"pulses", counts},
                             Entry{"radps", rad_per_s},
                             Entry{"rad/s", rad_per_s},
                             Entry{"rads", rad_per_s},
                             Entry{"degps", deg_per_s},
                             Entry{"deg/s", deg_per_s},
                             Entry{"dps", deg_per_s},
                             Entry{"\xc2\xb0/s", deg_per_s},
                             Entry{"rpm", rpm},
                             Entry{"1/min", rpm},
                             Entry{"u/min", rpm},
                             Entry{"r/min", rpm},
                             Entry{"rev/min", rpm},
                             Entry{"rps", {UnitKind::angular_speed, turn, "turns per second"}},
                             Entry{"mps", m_per_s},
                             Entry{"m/s", m_per_s},
                             Entry{"mmps", mm_per_s},
                             Entry{"mm/s", mm_per_s},
                             Entry{"radps2", acceleration},
                             Entry{"rad/s2", acceleration},
                             Entry{"rad/s^2", acceleration},
                             Entry{"m/s2", acceleration},
                             Entry{"m/s^2", acceleration},
                             Entry{"mps2", acceleration},
                             Entry{"nm", newton_metres},
                             Entry{"n*m", newton_metres},
                             Entry{"n.m", newton_metres},
                             Entry{"mnm", milli_newton_metres},
                             Entry{"nmm", milli_newton_metres},
                             Entry{"ncm", {UnitKind::torque, 1e-2, "N cm"}},
                             Entry{"knm", {UnitKind::torque, 1e3, "kN m"}},
                             Entry{"n", {UnitKind::force, 1.0, "N"}},
                             Entry{"kn", {UnitKind::force, 1e3, "kN"}},
                             Entry{"a", amperes},
                             Entry{"amp", amperes},
                             Entry{"amps", amperes},
                             Entry{"arms", amperes},
                             Entry{"ma", milliamperes},
                             Entry{"v", volts},
                             Entry{"volt", volts},
                             Entry{"volts", volts},
                             Entry{"mv", millivolts},
                             Entry{"pct", percent},
                             Entry{"percent", percent},
                             Entry{"prozent", percent},
                             Entry{"%", percent},
                             Entry{"permille", permille},
                             Entry{"promille", permille},
                             Entry{"permil", permille},
                             Entry{"\xe2\x80\xb0", permille}};

}  // namespace column_units

std::optional<ColumnUnit> column_unit(std::string_view word) {
  auto const found = std::find_if(column_units::entries.begin(), column_units::entries.end(),
                                  [&](auto const& e) { return e.word == word; });
  return found == column_units::entries.end() ? std::nullopt : std::optional(found->unit);
}

bool is_short_unit(std::string_view word) { return word.size() == 1; }

}  // namespace torquescope
