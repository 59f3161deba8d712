#include "engine/experiment/simulated_recordings.hpp"

#include <utility>

namespace torquescope {

Recording as_recording(SimulatedRecording&& simulated) {
  Recording recording;
  recording.name = std::move(simulated.name);
  recording.sha256 = std::move(simulated.sha256);
  recording.rate_hz = simulated.rate_hz;
  recording.time_s = std::move(simulated.time_s);
  recording.position = std::move(simulated.position);
  recording.torque = std::move(simulated.torque);
  simulated.true_torque = Eigen::VectorXd();
  recording.reference = std::move(simulated.reference);
  if (simulated.has_exact_motion) {
    recording.velocity = std::move(simulated.true_velocity);
    recording.acceleration = std::move(simulated.true_acceleration);
  }
  if (simulated.saturated_samples > 0)
    recording.warnings.push_back(
        {"saturation", std::to_string(simulated.saturated_samples) + " samples at the simulated motor's limit"});
  return recording;
}

SimulationSections simulation_sections(Job const& job) {
  return {job.find("simulate"),           job.find("simulate.plant"),
          job.find("simulate.reference"), job.find("simulate.controller"),
          job.find("simulate.encoder"),   job.find("simulate.noise")};
}

SimulationPlan plan_simulation(Job const& job, JointKind joint, std::vector<Problem>& problems) {
  if (Section const* effects = job.find("simulate.effects"))
    problems.push_back(problem_at(*effects, "", "[[simulate.effects]] are of the joints of an arm",
                                  "write the effect's parameters in [simulate.plant], or model.robot"));
  return read_simulation(simulation_sections(job), joint, problems);
}

SimulatedRecordings simulate_recordings(SimulationPlan const& plan, std::uint64_t seed) {
  SimulatedRecordings recordings;
  SimulatedRecording train = simulate_joint(plan, seed, 0, TrueTorque::left_out);
  for (auto const& value : train.truth) recordings.truth.emplace_back(value.name, value.value);
  recordings.train = as_recording(std::move(train));
  if (plan.simulation.validate)
    recordings.validate.push_back(as_recording(simulate_joint(plan, seed, 1, TrueTorque::left_out)));
  return recordings;
}

}  // namespace torquescope
