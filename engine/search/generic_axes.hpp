#pragma once
// How much of a mismatch is a smooth function of something, whatever the function.
//
// Axes       splines of position, velocity, time, acceleration; of position and of time with a sign or a size (s q, v
//            q, a q, s t, v t, a t); position and velocity together; the torque so far
// Equation   share = (energy of the mismatch in the span beside the model, less that of noise) / excess
// Shapes     hats over quantiles of the axis, 12 knots; 8 x 8 for two axes
// Threads    free function
// Source     METHOD.md, Adequacy of the final model

#include <string>
#include <vector>

#include "engine/search/candidate_columns.hpp"

namespace torquescope {

struct GenericAxis {
  std::string name;                   // for people: "velocity", "friction over position"
  std::vector<SignatureAxis> axes{};  // of the mismatch map: those it is a function of
  double share = 0.0;                 // of the excess
};

// strongest first; excess: of the stage, above 0
std::vector<GenericAxis> generic_axes(CandidateColumns const& columns, double excess);

}  // namespace torquescope
