#pragma once
// A torque column that a model gave for the commanded motion, written as if it had been measured.
//
// Equation   column = function of the commanded motion; of the measured motion it leaves three times as much
// Told       where neither a measured position that comes late, nor one that is derived (not the velocity column), nor
//            the encoder's noise can be why: another noise of that size adds next to nothing to what the motion leaves.
//            K (reference - position) is a torque: the measured motion explains it
// Shapes     one recording a joint; functions of a motion: torque_beside_motion.hpp, alike for both motions
// Threads    pure function

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "engine/data/recording.hpp"
#include "engine/fit/problem/torque_beside_motion.hpp"

namespace torquescope {

struct ComputedTorque {
  std::size_t joint = 0;
  double error_of_motion = 0.0, error_of_reference = 0.0;  // of the torque, relative
};

using BesideOfJoints = std::vector<std::optional<TorqueBesideMotion>>;
// [N] the same recordings, moved along these positions [N][n]; their velocities are derived
using BesidePositions = std::function<BesideOfJoints(std::vector<Eigen::VectorXd> const& positions)>;

// measured: of the joints as recorded. None where a joint has no reference
std::vector<ComputedTorque> computed_torques(std::vector<Recording> const& joints, BesideOfJoints const& measured,
                                             BesidePositions const& beside);

// a torque smoother than any sensor's beside a position that was measured: computed, or filtered afterwards
bool carries_no_noise(Recording const& joint);

}  // namespace torquescope
