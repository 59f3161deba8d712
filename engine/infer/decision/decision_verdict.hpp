#pragma once
// What the facts of a decision say of its model and of its names: the table of verdicts.
//
// Adequate   replicates of the model leave as much as the recording: no smooth correction is beyond chance, and no
//            effect, but such as would not lower the error by least_fall, or are smaller than one that is taken
// Complete   adequate, and an effect as large as the tolerance would most likely have come out, or is more than the
//            model leaves
// Threads    pure functions
// Source     engine/infer/decision/THEORY.md, Adequacy

#include <span>

#include "engine/infer/decision/decision_facts.hpp"
#include "engine/infer/decision/decision_numbers.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

bool is_adequate(StepFacts const& step, DecisionNumbers const& numbers);
// no effect of the motion is beyond chance and yet refused: effects of a clock would only stand for it
bool bears_effects_of_clock(StepFacts const& step);
// steps: all that were asked beside one model; none: it is not
bool is_complete(std::span<StepFacts const> steps, DecisionNumbers const& numbers);
// of the model without effects
bool was_adequate(DecisionFacts const& facts, DecisionNumbers const& numbers);
// the torque, over its rms, of an effect of the motion that would most likely have been named beside the last model:
// beyond chance, and worth a name; NaN: none was asked
double smallest_named(DecisionFacts const& facts, DecisionNumbers const& numbers);

struct DecisionOutcome {
  bool neighbours_predict = false;  // other joints' motion says more than any name
  bool was_adequate = false, has_names = false, is_lower = false, is_complete = false;
  bool all_on_channel = false, has_class = false;  // of the names
  bool can_tell_little = false;                    // poor motion, or an effect must be larger than the tolerance
};
Verdict verdict_from(DecisionOutcome const& of);

}  // namespace torquescope
