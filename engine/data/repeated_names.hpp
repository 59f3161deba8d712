#pragma once
// Columns of one name, told apart by their order: "Time", "Time" are "Time#1", "Time#2".
//
// Threads    functions of their arguments

#include <string>
#include <vector>

namespace torquescope {

// names that stand once stay as they are
std::vector<std::string> with_numbers_of_repeats(std::vector<std::string> names);

// the number behind the last '#', "" without one; and the name without it
std::string number_of_repeat(std::string const& name);
std::string without_repeat(std::string const& name);

}  // namespace torquescope
