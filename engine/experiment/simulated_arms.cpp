#include "engine/experiment/simulated_arms.hpp"

#include "engine/experiment/arm_motion_file.hpp"
#include "engine/experiment/simulated_recordings.hpp"

namespace torquescope {

namespace {

std::vector<Recording> as_recordings(SimulatedArm&& arm) {
  std::vector<Recording> joints;
  for (auto& joint : arm.joints) joints.push_back(as_recording(std::move(joint)));
  // what a file would have: one name and one checksum
  for (auto& joint : joints) {
    joint.name = arm.name;
    joint.sha256 = arm.sha256;
  }
  return joints;
}

// the reference's files, one a recording
std::vector<std::string> motion_files(ReferenceOptions const& reference) {
  std::vector<std::string> files;
  for (auto const& file : {reference.file, reference.validate_file})
    if (!file.empty()) files.push_back(file);
  return files;
}

}  // namespace

ArmSimulationPlan plan_arm_simulation(Job const& job, SerialChain const& chain, std::vector<Problem>& problems) {
  ArmSimulationSections const sections{simulation_sections(job), job.all("simulate.effects")};
  ArmSimulationPlan plan = read_arm_simulation(sections, chain, problems);
  if (plan.joints.empty()) return plan;
  for (auto const& file : motion_files(plan.joints.front().reference))
    plan.motions.push_back(read_arm_motion(job.resolve(file), chain, *job.find("simulate.reference")));
  return plan;
}

SimulatedArms simulate_arms(ArmSimulationPlan const& plan, std::uint64_t seed) {
  SimulatedArms arms;
  for (auto const& value : truth_values(plan)) arms.truth.emplace_back(value.name, value.value);
  arms.train = as_recordings(simulate_arm(plan, seed, 0));
  if (plan.simulation.validate) arms.validate.push_back(as_recordings(simulate_arm(plan, seed, 1)));
  return arms;
}

}  // namespace torquescope
