#pragma once
// Where the shapes of effects begin in a fit by simulation: those that explain most of what least squares leaves.
//
// How        one effect after the other, each on what those before it leave: its open shape on a grid over its range,
//            at every value the linear parameters by least squares on the measured motion (inverse dynamics)
// Grid       of a wave half a wave apart over the travel or the time, else forty values; of an effect with several open
//            shapes the others stand in the middle of their ranges
// Why        a sum over an order has a minimum every half wave: a slope finds the one that it begins in
// Units      SI
// Threads    free function

#include <Eigen/Core>
#include <vector>

#include "engine/effects/fitted_baseline.hpp"
#include "engine/simulate/rollout/rollout_model.hpp"

namespace torquescope {

// effects whose first open shape and whose linear parameters have values; those that the job gives stay.
// left: [n] torque less that of the baseline on the motion
std::vector<ModelEffect> with_first_shapes(std::vector<ModelEffect> effects, Motion const& motion,
                                           FittedBaseline const& baseline, Eigen::VectorXd left);

}  // namespace torquescope
