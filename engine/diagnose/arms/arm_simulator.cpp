#include "engine/diagnose/arms/arm_simulator.hpp"

#include <algorithm>

#include "engine/infer/pipeline/held_torque.hpp"
#include "engine/infer/pipeline/simulator_gap.hpp"

namespace torquescope {
namespace {

// the same motion with another torque of each joint
template <class Torque>
std::vector<RecordedArm> with_torque(std::span<RecordedArm const> recordings, Torque const& torque_of) {
  std::vector<RecordedArm> others(recordings.begin(), recordings.end());
  for (auto& recording : others)
    for (auto& joint : recording.joints) joint.torque = torque_of(joint);
  return others;
}

RecordedArm less_beyond(ArmModel const& model, Eigen::VectorXd const& of_simulator, RecordedArm recording,
                        ArmFilter const& filter) {
  auto const needed = needed_torques(model, of_simulator, recording, filter);
  for (std::size_t j = 0; j < needed.size(); ++j) {
    Recording& joint = recording.joints[j];
    Motion const motion = differentiate(joint, filter.options, filter.section);
    Eigen::VectorXd beyond = bridged_over_rests(joint.simulated_torque - needed[j], motion.dq, joint.rate_hz);
    joint.torque -= torque_to_hold(beyond);
    joint.gear_load = std::move(beyond);
    joint.simulated_torque.resize(0);
  }
  return recording;
}

}  // namespace

bool has_simulator(std::span<RecordedArm const> recordings) {
  return std::any_of(recordings.begin(), recordings.end(),
                     [](RecordedArm const& one) { return one.joints.front().simulated_torque.size() > 0; });
}

ArmWithoutSimulator without_simulator(ArmModel const& model, std::span<RecordedArm const> train,
                                      std::span<RecordedArm const> validate, ArmFilter const& filter) {
  // a simulator has hardly any noise of its own: its joints count as those of the arm do
  auto const noise = fit_parameters(model, train, filter).noise;
  auto const simulated =
      with_torque(train, [](Recording const& joint) { return torque_to_hold(joint.simulated_torque); });
  Eigen::VectorXd const of_simulator = fit_parameters(model, simulated, filter, noise).parameters;

  ArmWithoutSimulator arm;
  for (auto const& recording : train) arm.train.push_back(less_beyond(model, of_simulator, recording, filter));
  for (auto const& recording : validate) arm.validate.push_back(less_beyond(model, of_simulator, recording, filter));

  // payloads are in both torques
  auto gap = with_torque(train, [](Recording const& joint) -> Eigen::VectorXd {
    return joint.torque - torque_to_hold(joint.simulated_torque);
  });
  for (auto& recording : gap) recording.payload.reset();
  for (auto const& joint : fit_parameters(model, gap, filter, noise).energies)
    arm.parameter_share.push_back(joint.torque > 0.0 ? std::max(0.0, 1.0 - joint.left / joint.torque) : 0.0);
  return arm;
}

}  // namespace torquescope
