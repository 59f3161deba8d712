#pragma once
// Mode "inverse_dynamics": the joint is exactly on its reference, and the torque is what the model asks plus noise.
//
// Equation   torque = Phi a + e; Phi: one column per linear parameter, from the exact velocity and acceleration
// Noise      index 0 with orthogonal_mse: orthogonal_noise(Phi); index 1: plain white noise of the same variance (data
//            that no fit has seen has no reason to be orthogonal); else torque_std and torque_coloured_std

#include "engine/simulate/joint_simulation.hpp"

namespace torquescope {

// `key.run` is the index of the recording
void record_exact_motion(SimulationPlan const& plan, Reference const& reference, RandomKey const& key, TrueTorque truth,
                         SimulatedRecording& recording);

}  // namespace torquescope
