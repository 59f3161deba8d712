#pragma once
// What other joints, the robot file or the world may do to the joints of an arm: columns of arm_effect_choices().
//
// Of a joint  friction and inertia of its neighbours (their recorded motion); judged as any effect of that joint
// Of the arm  gravity_direction, joint_compliance, joint_zero, payload_picked_up, tip_contact: several joints feel
//             the same parameters
// New effect one file in effects/arm_effects, one name in effects/CMakeLists.txt, one line in a table of
//            arm_effects.cpp
// Shapes      columns at the full rate of the motion
// Units       SI
// Threads     free functions

#include <optional>
#include <span>
#include <vector>

#include "engine/data/given_signals.hpp"
#include "engine/data/motion.hpp"
#include "engine/effects/effect.hpp"
#include "engine/fit/problem/arm_model.hpp"

namespace torquescope {

// of each joint the effects that it alone feels. motion: of each joint
std::vector<GivenSignals> arm_effect_signals(ArmModel const& model, std::vector<Motion> const& motion);

struct WholeArmEffect {
  Effect const* effect = nullptr;
  std::optional<std::size_t> joint{};      // whose zero; none: the effect has no place
  std::vector<Eigen::MatrixXd> columns{};  // [N] n x n_linear()
};

// those of the wanted effects that are of the whole arm, in the same order for every recording.
// parameters: [R] of the model, at which the robot file is varied. Spreads effects over `threads`; same bits always
std::vector<WholeArmEffect> whole_arm_effects(ArmModel const& model, Eigen::VectorXd const& parameters,
                                              std::vector<Motion> const& motion, std::span<Effect const* const> wanted,
                                              int threads = 1);

}  // namespace torquescope
