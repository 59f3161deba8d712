#pragma once
// Keys of a job that only an arm has, or only a joint.
//
// Errors     Problems (78)
// Threads    free functions

#include <string>
#include <vector>

#include "engine/experiment/experiment_parts.hpp"
#include "engine/fit/problem/arm_model.hpp"

namespace torquescope {

// of an arm's job: what only a job about one joint may have
void refuse_joint_keys(Job const& job, std::vector<Problem>& problems);

// what a diagnosis looks for at each joint: what neither its friction nor the rigid arm has already
void choose_arm_effects(Experiment::Parts& parts, std::vector<Problem>& problems);

// [[model.effects]] of an arm: effects of joints, with shapes where the job has them. Throws
std::vector<HeldEffect> read_arm_effects(Job const& job, SerialChain const& chain);

// of an arm with such effects: what would simulate it
void refuse_beside_effects(Job const& job, std::vector<EstimatorPlan> const& plans, std::vector<Problem>& problems);

// of an arm whose drives are coupled: what would simulate it
void refuse_beside_coupled_drives(Job const& job, std::vector<EstimatorPlan> const& plans,
                                  std::vector<Problem>& problems);

// torque_at = "motors" of an arm whose motors turn their own joints alone
void refuse_motor_torques(Job const& job, RecordingOptions const& options, SerialChain const& chain,
                          std::vector<Problem>& problems);

// of a job about one joint: what only an arm has
void refuse_arm_keys(Job const& job, std::vector<EstimatorPlan> const& plans, std::vector<Problem>& problems);

// of each joint: what stays in `terms` of model.friction, or what its own section says; the transmission of its drives
// (SerialChain::transmission). Throws
Eigen::MatrixXd read_joint_models(Job const& job, std::size_t joints, ArmTerms& terms);

}  // namespace torquescope
