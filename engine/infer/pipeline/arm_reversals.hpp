#pragma once
// The samples at which the joints of an arm move one way: what every motor does whose friction a joint feels.
//
// Equation   of joint j: all motors that turn with it are one way (reversal_mask.hpp); without coupled drives its own
// Shapes     motion: N joints; result: [N][n]
// Threads    free function

#include <vector>

#include "engine/fit/problem/arm_model.hpp"

namespace torquescope {

std::vector<std::vector<bool>> samples_one_way(ArmModel const& model, std::vector<Motion> const& motion,
                                               double cutoff_hz);

}  // namespace torquescope
