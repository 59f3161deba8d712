#pragma once
// Names of the effects that the scan took, with numbers, places and curves; without sentences.
//
// Waves      of one effect are one name, their parameters numbered
// Delay      last, where it is a name
// Numbers    95 % intervals of the jackknife; SI
// Threads    pure functions

#include <vector>

#include "engine/infer/decision/joint_decision.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

struct EffectNames {
  std::vector<NamedEffect> effects{};
  std::vector<ParameterEstimate> parameters{};  // of the final model: of the joint, of each effect, the delay
};

EffectNames names_of_scan(JointDecision const& decision);

// of the terms of the joint
std::vector<ParameterEstimate> estimates_of(JointModel const& model, std::vector<FittedNumber> const& numbers);

}  // namespace torquescope
