#include "engine/simulate/joint_simulation.hpp"

#include "engine/base/contract.hpp"
#include "engine/base/digest.hpp"
#include "engine/simulate/closed_loop.hpp"
#include "engine/simulate/exact_motion.hpp"

namespace torquescope {

SimulatedRecording simulate_joint(SimulationPlan const& plan, std::uint64_t experiment_seed, std::uint32_t index) {
  RandomKey const key{plan.simulation.seed >= 0 ? static_cast<std::uint64_t>(plan.simulation.seed) : experiment_seed,
                      index, RandomDomain::simulation};
  auto const reference = make_reference(plan.reference, plan.simulation.duration_s, key);

  SimulatedRecording recording;
  recording.name = index == 0 ? "simulated" : "simulated_unseen";
  recording.joint = plan.joint;
  recording.rate_hz = plan.simulation.rate_hz;
  recording.truth = truth_values(plan.plant, plan.joint);
  if (plan.simulation.mode == "inverse_dynamics")
    record_exact_motion(plan, *reference, key, recording);
  else
    record_closed_loop(plan, *reference, key, recording);

  Digest digest;
  digest.numbers({&recording.rate_hz, 1});
  for (auto const& column : columns(recording))
    digest.text(column.name).numbers({column.values->data(), static_cast<std::size_t>(column.values->size())});
  recording.sha256 = digest.hex();
  return recording;
}

std::vector<SimulatedColumn> columns(SimulatedRecording const& recording) {
  bool const revolute = recording.joint == JointKind::revolute;
  std::string const length = revolute ? "rad" : "m";
  std::string const torque = revolute ? "tau_Nm" : "F_N";
  std::string const torque_true = revolute ? "tau_true_Nm" : "F_true_N";
  std::string const torque_unit = revolute ? "N m" : "N";
  bool const exact = recording.has_exact_motion;
  auto const* const reference = exact ? &recording.position : &recording.reference;
  auto const* const true_position = exact ? &recording.position : &recording.true_position;
  return {
      {"t_s", "s", "time", &recording.time_s},
      {"q_ref_" + length, length, "reference", reference},
      {"q_" + length, length, "position", &recording.position},
      {torque, torque_unit, "torque", &recording.torque},
      {"q_true_" + length, length, "", true_position},
      {(exact ? "dq_" : "dq_true_") + length + "_s", length + "/s", exact ? "velocity" : "", &recording.true_velocity},
      {(exact ? "ddq_" : "ddq_true_") + length + "_s2", length + "/s^2", exact ? "acceleration" : "",
       &recording.true_acceleration},
      {torque_true, torque_unit, "", &recording.true_torque}};
}

}  // namespace torquescope
