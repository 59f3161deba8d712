#pragma once
// Whether the torque of a recording shows the weight of an eccentric link.
//
// Equation   share = 1 - |tau - [Y, sin q, cos q] a|^2 / |tau - Y b|^2, both least squares, Y the columns of `terms`
// Units      q in rad; a slide has no such weight
// Errors     as make_regression_data()
// Threads    free function

#include <string>
#include <vector>

#include "engine/data/motion.hpp"
#include "engine/data/recording.hpp"

namespace torquescope {

struct GravityEvidence {
  double range_rad = 0.0;     // of the position
  double share = 0.0;         // of the squared residual that the weight takes away
  double share_spring = 0.0;  // the same of q and q^2 in its place: a spring, a cable

  // half of the residual over half a radian, and no spring does clearly better: a diagnosis looks for both
  bool is_plain() const { return range_rad >= 0.5 && share >= 0.5 && 1 - share <= 1.1 * (1 - share_spring); }
};

GravityEvidence measure_gravity(Recording const& recording, FilterOptions const& filter,
                                std::vector<std::string> const& terms);

}  // namespace torquescope
