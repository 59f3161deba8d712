#pragma once
// The unit at the end of a quantity's name: "length_mm" is a length in mm. Two names that differ by it alone are one
// quantity in two units.
//
// Known      the units of data/unit_of_name.hpp, and kg, g and mg
// Threads    functions of their arguments

#include <optional>
#include <string>

#include "engine/data/unit_of_name.hpp"

namespace torquescope {

struct QuantityUnit {
  std::string stem;                  // "length"
  std::string word;                  // "mm"
  std::optional<Quantity> quantity;  // none: a mass
  double si = 1.0;                   // value of one unit in SI units
};

// nothing: the name has no '_', or no known unit behind its last one
std::optional<QuantityUnit> unit_of_quantity(std::string const& name);

// asked = factor * there, where both are one quantity in two units: 0.001 of "length_m" and "length_mm"
std::optional<double> factor_between(std::string const& asked, std::string const& there);

}  // namespace torquescope
