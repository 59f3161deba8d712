#pragma once
// Names of a diagnosis after the simulations in the loop: effects that did not stand go, what acts between command and
// motor comes.
//
// Numbers    where simulations decided, those of their final model
// Threads    pure functions
// Source     engine/infer/decision/THEORY.md, In the loop

#include "engine/infer/decision/loop_verdict.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

// joint: with a name for each effect that the scan took, then its delay if that is named
void keep_standing(JointDiagnosis& joint, DecisionFacts const& scan, LoopFacts const& loop, StandingNames const& names);

// whether what is left falls by least_fall: of the simulations where they decided, else of the judged rows as they are
// weighed, where the error of all rows alike does not rise
bool is_lower(DecisionFacts const& scan, LoopFacts const& loop, double least_fall);

}  // namespace torquescope
