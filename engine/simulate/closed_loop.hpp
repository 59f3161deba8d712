#pragma once
// Mode "closed_loop": a discrete controller moves the joint along the reference; between its ticks the joint is
// integrated in steps of at most step_s.
//
// At a tick  the encoder reads position + position noise; the controller answers; motor torque and disturbance are held
//            until the next tick
// A sample   is every n-th tick; torque noise is added to what is logged, not to what acts
// Start      on the reference, at its velocity
// Errors     Error 78 when the joint is further from its reference than 100 amplitudes

#include "engine/simulate/joint_simulation.hpp"

namespace torquescope {

// what is written down at a sample; its vectors are long enough
void record_sample(SimulatedRecording& recording, Eigen::Index i, JointState const& state, ReferencePoint const& wanted,
                   double measured_position, double logged_torque, double acting_torque);

void record_closed_loop(SimulationPlan const& plan, Reference const& reference, RandomKey const& key,
                        SimulatedRecording& recording);

}  // namespace torquescope
