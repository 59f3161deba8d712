#pragma once
// What stands in a list of numbers for one that is to be found; it is read as NaN: payload_kg = [0, "unknown"].
//
// Keys       an option takes it where it is one of its words
// Threads    constant

namespace torquescope {

inline constexpr char unknown_number[] = "unknown";

}  // namespace torquescope
