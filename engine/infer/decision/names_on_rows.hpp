#pragma once
// What the rows leave beside names that simulations decided on, where these are not the scan's.
//
// Fitted     kept moves with the shapes of the simulations, what stands beside them with the scan's; sizes, baseline
//            and delay are those of the rows
// Errors     of the rows (decision_facts.hpp); none where something on the command side was kept: rows do not show it
// Threads    pure functions
// Source     engine/infer/decision/THEORY.md, In the loop

#include <optional>

#include "engine/infer/decision/joint_decision.hpp"
#include "engine/infer/decision/loop_verdict.hpp"

namespace torquescope {

std::optional<ModelErrors> errors_of_names(DecisionQuestion const& question, JointDecision const& scan,
                                           LoopFacts const& loop, StandingNames const& names);
// judged rows are predicted better, by least_fall, with the scan's effects: what names drop of them is there
bool leave_more(ModelErrors const& names, ModelErrors const& scan, double least_fall);

}  // namespace torquescope
