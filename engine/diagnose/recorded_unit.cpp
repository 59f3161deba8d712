#include "engine/diagnose/recorded_unit.hpp"

#include "engine/base/torque_unit.hpp"

namespace torquescope {

void tell_in_recorded_unit(JointDiagnosis& joint) {
  auto const tell = [&](std::string& unit) { unit = in_torque_unit(unit, joint.unit_torque); };
  auto const tell_all = [&](std::vector<ParameterEstimate>& parameters) {
    for (auto& one : parameters) tell(one.unit);
  };
  tell_all(joint.baseline);
  tell_all(joint.augmented);
  for (auto& effect : joint.effects) {
    tell_all(effect.parameters);
    tell(effect.region.unit);
    for (auto& place : effect.places) tell(place.unit);
    tell(effect.curve.axis.unit);
  }
  for (auto& axis : joint.map) {
    tell(axis.unit);
    for (auto& region : axis.regions) tell(region.where.unit);
  }
  for (auto& part : joint.unexplained) tell(part.where.unit);
}

}  // namespace torquescope
