#pragma once
// Which quantity a number in a file's name is: "m0.5" a mass in kg, "l150" a length in mm, "12V" a supply.
//
// Size       decides on units that are not written, and whether the usual meaning is plausible
// Threads    function of its arguments

#include <string>
#include <vector>

namespace torquescope {

// the letters before the numbers, the unit behind them; "": not known
std::string quantity_of_number(std::string const& prefix, std::string const& unit, std::vector<double> const& values);

}  // namespace torquescope
