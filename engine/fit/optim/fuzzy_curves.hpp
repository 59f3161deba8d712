#pragma once
// What a page draws of a fuzzy controller: the membership curves of its six variables and its two decision surfaces.
//
// Shapes     curves: n_points per set; surface: first x second, row-major

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/fit/optim/fuzzy_controller.hpp"

namespace torquescope {

struct MembershipCurves {
  FuzzyVariable variable;
  std::vector<double> x;                           // 0 .. variable.top, equally spaced
  std::array<std::vector<double>, 3> memberships;  // small, middle, big at x
};

struct DecisionSurface {
  std::string first_name, second_name, output_name;
  std::vector<double> first, second;  // values of the inputs over their universes
  std::vector<double> output;
};

// both inputs and the output of the F controller, then of the CR controller
std::vector<MembershipCurves> membership_curves(FuzzyController const& controller, std::size_t n_points);

DecisionSurface decision_surface(MamdaniSystem const& system, std::size_t n_points);

}  // namespace torquescope
