#pragma once
// From a job with model.robot to the parts of an Experiment: the arm, its recordings joint by joint, and their rows.
//
// Errors     those of read_robot(), read_joint_models(), ArmModel, make_arm_recording() and the filters
// Threads    free functions

#include <vector>

#include "engine/data/recorded_tables.hpp"
#include "engine/effects/model_options.hpp"
#include "engine/experiment/arm_payloads.hpp"
#include "engine/experiment/experiment_parts.hpp"
#include "engine/simulate/arm_simulation_plan.hpp"

namespace torquescope {

ArmParts read_arm(Job const& job, ModelOptions const& options, std::vector<Payload> const& payloads = {});

// fills train, validate, the filter where the job has none, and what the arm's training rows tell
void use_arm_files(Experiment::Parts& parts, RecordingOptions const& options, PayloadPlan const& payloads,
                   RecordedTables const& tables, Experiment::Purpose purpose);
// the same, and truth, from a simulation
void use_arm_simulation(Experiment::Parts& parts, ArmSimulationPlan const& plan);

}  // namespace torquescope
