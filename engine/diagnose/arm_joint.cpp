#include "engine/diagnose/arm_joint.hpp"

#include <string>
#include <utility>
#include <vector>

#include "engine/account/sentences.hpp"
#include "engine/base/torque_unit.hpp"

namespace torquescope {

Regressor own_terms(ArmModel const& model, std::size_t joint) {
  std::vector<std::string> terms{"inertia"};
  auto const& friction = model.friction()[joint];
  if (friction)
    for (Effect const* effect : friction->terms()) terms.push_back(effect->name());
  return {terms, model.chain().joints[joint].kind, friction ? friction->velocity_deadband() : 0.0};
}

Diagnosis hopeless_joint(DiagnosisInput const& input, Hopeless const& why) {
  Diagnosis diagnosis;
  diagnosis.verdict = why.verdict;
  diagnosis.finding = why.finding;
  diagnosis.way_out = why.way_out;
  JointDiagnosis joint;
  bool const revolute = input.regressor.joint() == JointKind::revolute;
  joint.joint = input.joint;
  joint.unit_position = revolute ? "rad" : "m";
  joint.unit_torque = in_torque_unit(revolute ? "N m" : "N", input.train.torque_unit);
  diagnosis.joints.push_back(std::move(joint));
  diagnosis.reason = reason_sentence(diagnosis);
  return diagnosis;
}

}  // namespace torquescope
