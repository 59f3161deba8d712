#pragma once
// Blocks of columns that each begin with a clock of their own: "X, Y, X, Y", "Time, Position, Time, Torque".
//
// Clock      runs forwards in every row that it has, its rows begin at the first one, and its name says time, or X, or
//            is that of another clock with another number behind "#"; it has a column behind it that is no clock
// Blocks     two clocks or more whose stretches of time overlap in more than half of the shorter one
// Lengths    a table whose columns have several knows the clocks (block_lengths.hpp)
// Threads    free function

#include <map>
#include <string>

#include "engine/data/recording_reader.hpp"

namespace torquescope {

// the clock of each column of a block, by name; empty where the table has no such blocks
std::map<std::string, std::string> clocks_of_columns(RawTable const& table);

// whether two columns hold the same stamps
bool is_same_clock(RawTable const& table, std::string const& one, std::string const& other);

}  // namespace torquescope
