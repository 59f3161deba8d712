#pragma once
// What the rows leave beside the effects that simulations kept, where these are not the scan's.
//
// Fitted     with the shapes of the simulations; sizes, baseline and delay are those of the rows
// Errors     of the rows (decision_facts.hpp); none where something on the command side was kept: rows do not show it
// Threads    pure function
// Source     engine/infer/decision/THEORY.md, In the loop

#include <optional>

#include "engine/infer/decision/joint_decision.hpp"
#include "engine/infer/decision/loop_facts.hpp"

namespace torquescope {

std::optional<ModelErrors> kept_errors(DecisionQuestion const& question, JointDecision const& scan,
                                       LoopFacts const& loop);

}  // namespace torquescope
