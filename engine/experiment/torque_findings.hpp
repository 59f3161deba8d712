#pragma once
// What a torque column is, beside the motion that it should have caused: a command beyond the drive's limit, a zero
// that steps or drifts, a model's torque of the commanded motion (problem/command_limit.hpp, torque_zero.hpp,
// computed_torque.hpp).
//
// Command    rows beyond the limit are taken as the limit, which is what the joint got: leaving them out would also
//            take away what a filter mixes with them. To a diagnosis it is a fault: what is left of it looks like
//            physics
// Zero       taken out of the torque for a fit; a diagnosis leaves it in, for it has an effect of its own to name
// Threads    free functions

#include <optional>
#include <vector>

#include "engine/data/recording.hpp"
#include "engine/experiment/experiment_parts.hpp"
#include "engine/fit/problem/recorded_arm.hpp"

namespace torquescope {

// of recordings from files, of one joint
void examine_torques(std::vector<Recording>& recordings, Experiment::Parts const& parts,
                     RecordingOptions const& options, Experiment::Purpose purpose);
// the same of every joint of an arm, beside the whole arm's motion
void examine_arm_torques(std::vector<RecordedArm>& files, Experiment::Parts const& parts,
                         RecordingOptions const& options, Experiment::Purpose purpose);

// a torque of these was: masses and frictions of the fit are then the model's
bool is_computed(std::vector<Recording> const& recordings);

// the finding that the torque's zero changes; none where there is no such
std::optional<Finding> zero_finding(std::vector<Finding> const& findings);

}  // namespace torquescope
