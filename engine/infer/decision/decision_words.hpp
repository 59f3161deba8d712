#pragma once
// Enums of a decision as words of a result file.
//
// Threads    pure functions

#include <string>

#include "engine/infer/decision/decision_facts.hpp"
#include "engine/infer/decision/loop_facts.hpp"

namespace torquescope {

std::string word(Refusal refusal);
std::string clause(Refusal refusal);       // why an effect is no name         // "too_small"
std::string word(ReplicateSource source);  // "recorded_torque"
std::string word(LoopReason reason);       // "no_reference"
std::string word(MoveRefusal refusal);     // "not_predicted"

}  // namespace torquescope
