#pragma once
// The second stage of a decision: what simulations in the loop say of the effects that the scan of rows found, and of
// what acts between command and motor.
//
// Loop       the job's [loop]; where it names no controller, one is looked for (loop_tracks.hpp)
// Errors     none: what cannot be simulated is a reason (LoopReason)
// Threads    spreads work over the question's threads; same bits for any number
// Source     engine/infer/decision/THEORY.md, In the loop

#include "engine/infer/decision/joint_decision.hpp"
#include "engine/infer/decision/loop_facts.hpp"
#include "engine/simulate/rollout/loop_options.hpp"

namespace torquescope {

LoopFacts decide_in_loop(DecisionQuestion const& question, JointDecision const& scan, LoopOptions const& loop);

}  // namespace torquescope
