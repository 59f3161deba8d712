#pragma once
// What the drive of a joint gave in all: a recording whose torque is less what passes the gear beside the model
// (Recording::gear_load) holds the joint's own part alone.
//
// Shapes     n_samples; units as the torque, held from sample to sample (held_torque.hpp)
// Threads    free functions

#include <Eigen/Core>

#include "engine/data/recording.hpp"

namespace torquescope {

// what the recording's torque is less than the drive's: zeros where nothing was taken out
Eigen::VectorXd torque_taken_out(Recording const& recording);
Eigen::VectorXd drive_torque(Recording const& recording);

}  // namespace torquescope
