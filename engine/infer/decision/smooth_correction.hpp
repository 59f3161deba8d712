#pragma once
// Whether anything is left that goes with the motion, whatever its form: D of smooth functions of one axis each.
//
// Axes       position, position where the joint moves back, velocity, acceleration, time; piecewise linear, 12 knots
// Rows       of the motion at the rows, not filtered; of all recordings together, and of each alone
// Threads    pure functions
// Source     engine/infer/decision/THEORY.md, Adequacy

#include <array>
#include <vector>

#include "engine/effects/effect_traits.hpp"
#include "engine/infer/decision/effect_scan.hpp"

namespace torquescope {

struct SmoothCorrection {
  SignatureAxis axis = SignatureAxis::position;
  double gain = 0.0;  // D
  double rms = 0.0;   // torque
};

// the one that gains most
SmoothCorrection best_correction(FittedStrips const& fitted, Score const& score, Eigen::Index signal = 0);

}  // namespace torquescope
