#pragma once
// The [simulate] part of an arm's job, read and checked.
//
// Plant      inertias come from the robot file. [simulate.plant] names what every joint has beside them ("viscous");
//            each [[simulate.effects]] one effect at one joint, with memory or without
// Lists      joint_sections.hpp
// Defaults   reference: within the limits of each joint; encoder: the step of the robot file; torque_limit: its
//            max_torque; step_s: 2.5e-4 s in place of a joint's
// Errors     read_arm_simulation collects Problems (exit code 78), all at once; use the plan only when there are none

#include <vector>

#include "engine/simulate/arm_simulation.hpp"

namespace torquescope {

// small enough for dry friction of light wrists
inline constexpr double arm_step_s = 2.5e-4;

struct ArmSimulationSections {
  SimulationSections simulate{};
  std::vector<Section const*> effects{};  // [[simulate.effects]], each with joint = and name =
};

// motions are left empty: whoever reads files adds them
ArmSimulationPlan read_arm_simulation(ArmSimulationSections const& sections, SerialChain const& chain,
                                      std::vector<Problem>& problems);

}  // namespace torquescope
