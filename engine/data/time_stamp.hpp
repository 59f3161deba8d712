#pragma once
// Dates and clock times in the cells of a text file.
//
// Dates      2024-05-01T12:00:00.123, a blank for the T, Z or +02:00 behind it (none: UTC); also 2024/05/01, 01.05.2024
//            and 05/01/2024 (month first unless that is above 12)
// Clocks     12:34:56.789, 12:34:56,789, 12:34:56:789, 1:02:03 PM
// Units      s since 1970-01-01T00:00Z, or s of the day
// Threads    functions of their arguments
// Source     ISO 8601-1:2019

#include <string_view>

namespace torquescope {

inline constexpr double seconds_of_day = 86400.0;

enum class StampKind { none, clock, date };

StampKind read_stamp(std::string_view cell, double& seconds);

}  // namespace torquescope
