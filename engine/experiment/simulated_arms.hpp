#pragma once
// The recordings of an arm that a job's [simulate] describes, as if they had been read from files.
//
// Errors     Error 78 with every problem of the [simulate] sections, or when the closed loop runs away; those of
//            read_arm_motion()

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/data/recording.hpp"
#include "engine/experiment/job/job.hpp"
#include "engine/simulate/arm_simulation_plan.hpp"

namespace torquescope {

// problems are appended; the plan is usable only when there are none
ArmSimulationPlan plan_arm_simulation(Job const& job, SerialChain const& chain, std::vector<Problem>& problems);

struct SimulatedArms {
  std::vector<Recording> train;                       // one a joint
  std::vector<std::vector<Recording>> validate;       // one recording, or none
  std::vector<std::pair<std::string, double>> truth;  // "xxr2", "viscous_3"
};
SimulatedArms simulate_arms(ArmSimulationPlan const& plan, std::uint64_t seed);

}  // namespace torquescope
