#pragma once
// The recordings of a set as rows of least squares: beside the command and the known load, what the joint itself took.
//
// Torque     motor_gain of servo_start() times the command, less the known weight and inertia; N m, no measurement
// Threads    pure function

#include <vector>

#include "engine/experiment/servo_job.hpp"

namespace torquescope {

struct ServoSources {
  std::vector<Recording> train{}, validate{};
};

ServoSources servo_sources(ServoJob const& servo);

}  // namespace torquescope
