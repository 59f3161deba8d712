#pragma once
// Whether anything is left that goes with the motion, whatever its form: D of smooth functions of one axis each, and of
// what remembers the motion (memory_columns.hpp), for which the axis is the frequency.
//
// Axes       position, position where the joint moves back, velocity, acceleration, time: of the motion at the rows, as
//            it is; piecewise linear, 12 knots
// Rows       of all recordings together, and of each alone
// Threads    pure functions
// Source     engine/infer/decision/THEORY.md, Adequacy

#include <array>
#include <vector>

#include "engine/effects/effect_traits.hpp"
#include "engine/infer/decision/effect_scan.hpp"

namespace torquescope {

// one after another, in an order that a recording and its replicates share
struct SmoothCorrections {
  std::vector<SignatureAxis> axes{};
  Eigen::VectorXd gains{};  // D
  Eigen::VectorXd rms{};    // torque
};

SmoothCorrections smooth_corrections(FittedStrips const& fitted, Score const& score);

}  // namespace torquescope
