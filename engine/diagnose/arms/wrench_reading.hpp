#pragma once
// How the wrench at the tip of an arm is to be read: in which frame, and on whom it acts.
//
// Equation   the torque of the joints with each reading's J' w added, fitted as a set-up (setup_fit.hpp)
// Threads    pure function

#include <Eigen/Core>

#include "engine/diagnose/arms/arm_setup.hpp"

namespace torquescope {

enum class WrenchReading { as_written, other_side, other_frame, other_side_and_frame };

struct WrenchFit {
  WrenchReading best = WrenchReading::as_written;
  Eigen::VectorXd without, as_written, at_best;  // [N] held-out errors, of the torque as it is with the wrench
};

// samples.tau has samples.outside in it. best: what halves the error of a joint and makes none worse
WrenchFit fit_wrench(ArmSamples const& samples, SerialChain const& chain);

}  // namespace torquescope
