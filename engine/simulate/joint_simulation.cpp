#include "engine/simulate/joint_simulation.hpp"

#include <algorithm>
#include <span>

#include "engine/base/contract.hpp"
#include "engine/base/digest_batch.hpp"
#include "engine/simulate/closed_loop.hpp"
#include "engine/simulate/exact_motion.hpp"

namespace torquescope {

// an array of two names counts once
std::string digest_of(SimulatedRecording const& recording) {
  Digest digest;
  auto const samples = static_cast<double>(recording.time_s.size());
  digest.numbers({&recording.rate_hz, 1}).numbers({&samples, 1});
  std::vector<Eigen::VectorXd const*> digested{&recording.time_s};
  for (auto const& column : columns(recording)) {
    if (column.channel.empty()) continue;
    digest.text(column.channel).text(column.name);
    if (std::find(digested.begin(), digested.end(), column.values) != digested.end()) continue;
    digested.push_back(column.values);
    auto const n = static_cast<std::size_t>(column.values->size());
    Sha256 const of_values = sha256_by_blocks(std::as_bytes(std::span(column.values->data(), n)));
    digest.bytes(of_values.data(), of_values.size());
  }
  return digest.hex();
}

SimulatedRecording simulate_joint(SimulationPlan const& plan, std::uint64_t experiment_seed, std::uint32_t index,
                                  TrueTorque truth) {
  RandomKey const key{plan.simulation.seed >= 0 ? static_cast<std::uint64_t>(plan.simulation.seed) : experiment_seed,
                      index, RandomDomain::simulation};
  auto const reference = make_reference(plan.reference, plan.simulation.duration_s, key);

  SimulatedRecording recording;
  recording.name = index == 0 ? "simulated" : "simulated_unseen";
  recording.joint = plan.joint;
  recording.rate_hz = plan.simulation.rate_hz;
  recording.truth = truth_values(plan.plant, plan.joint);
  if (plan.simulation.mode == "inverse_dynamics")
    record_exact_motion(plan, *reference, key, truth, recording);
  else
    record_closed_loop(plan, *reference, key, recording);

  recording.sha256 = digest_of(recording);
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
