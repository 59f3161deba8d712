#pragma once
// The recordings a job's [simulate] describes, as if they had been read from files.
//
// Errors     Error 78 with every problem of the [simulate] sections, or when the closed loop runs away

#include <string>
#include <utility>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/data/recording.hpp"
#include "engine/experiment/job/job.hpp"
#include "engine/simulate/joint_simulation.hpp"

namespace torquescope {

struct SimulatedRecordings {
  Recording train;
  std::vector<Recording> validate;                    // one, or none
  std::vector<std::pair<std::string, double>> truth;  // parameter name, value
};

// the job's sections of those names
SimulationSections simulation_sections(Job const& job);
// what a reader would have made of the file that `torquescope simulate` writes
Recording as_recording(SimulatedRecording&& simulated);

// problems are appended; the plan is usable only when there are none
SimulationPlan plan_simulation(Job const& job, JointKind joint, std::vector<Problem>& problems);
// the reference of an exact motion is its position, and left out
SimulatedRecordings simulate_recordings(SimulationPlan const& plan, std::uint64_t seed);

}  // namespace torquescope
