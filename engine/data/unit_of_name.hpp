#pragma once
// The unit that a column's name or its row of units tells: "q_deg", "t [ms]", "Torque (per mille)", "pos_cnt".
//
// Rule       what stands in brackets, else the last word of a name of several words; nothing is guessed from one word
// Threads    functions of their arguments

#include <optional>
#include <string>

namespace torquescope {

enum class Quantity {
  time,
  angle,
  length,
  angular_speed,
  speed,
  acceleration,
  torque,
  force,
  current,
  voltage,
  ratio,
  counts
};

struct NamedUnit {
  std::string word;  // as a person writes it: "deg", "ms", "per mille"
  Quantity quantity = Quantity::time;
  double si = 1.0;  // value of one unit in s, rad, m, rad/s, m/s, N m, N, A, V; 1 for counts; of the whole for a ratio
};

// `units`: what a row of units says of this column, "" without one
std::optional<NamedUnit> unit_of_name(std::string const& column, std::string const& units = "");

// of a unit alone, in lower case: "deg", "n m"
std::optional<NamedUnit> known_unit(std::string const& word);

// whether one unit has a value in SI units: what a count, an ampere or a percent makes depends on the drive
bool tells_si(NamedUnit const& unit);

}  // namespace torquescope
