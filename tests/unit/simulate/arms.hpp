#pragma once
// Arms with friction for the tests of the simulator.

#include <map>
#include <string>

#include "engine/simulate/arm_simulation.hpp"
#include "unit/robot/example_arms.hpp"
#include "unit/simulate/plants.hpp"

namespace torquescope::test {

// the same terms at every joint
inline std::vector<ArmJointTerms> every_joint(SerialChain const& chain,
                                              std::initializer_list<std::pair<std::string, OptionValue>> parameters) {
  std::vector<PlantTerm> const terms = parameters.size() == 0 ? std::vector<PlantTerm>{} : plant(parameters);
  return std::vector<ArmJointTerms>(chain.joints.size(), {terms, {}});
}

inline ArmPlant arm_plant(SerialChain const& chain,
                          std::initializer_list<std::pair<std::string, OptionValue>> parameters = {}) {
  return {chain, standard_parameters(chain, DriveInertias::included), every_joint(chain, parameters)};
}

// three revolute joints or so, friction at each, one second
inline ArmSimulationPlan arm_plan(std::uint32_t number = 8) {
  ArmSimulationPlan plan;
  plan.chain = random_arm(number, false, true).chain;
  plan.simulation.duration_s = 1.0;
  plan.simulation.rate_hz = 200.0;
  plan.simulation.step_s = 5e-4;
  auto const terms = every_joint(plan.chain, {{"viscous", 0.4}, {"coulomb", 0.3}, {"offset", 0.05}});
  for (auto const& joint_terms : terms) {
    ArmJointPlan joint;
    joint.terms = joint_terms;
    joint.reference.amplitude = 0.5;
    joint.reference.band_hz = {0.5, 2.0};
    joint.reference.base_hz = 0.5;
    joint.controller.kind = "pd";
    plan.joints.push_back(joint);
  }
  return plan;
}

}  // namespace torquescope::test
