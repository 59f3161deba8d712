#pragma once
// Which names stand after the simulations in the loop.
//
// Decides    where simulations do not decide, the scan's names stand. Where they do: an effect of the scan stands if
//            the ladder kept it, or cannot tell it from one it kept; what it kept beside is a name as well
// Clock      other recordings do not judge an effect of an instant or a clock: one that was not kept stands all the
//            same, unless simulations call it chance, or kept something on the command side, which it may have stood
//            for
// Chance     an effect that simulations asked and replicates reached says nothing against the scan's model, either
// Classes    the scan tells an effect from its rivals beside its own model. Where the names are of another model, the
//            classes are those of simulations: an effect that they cannot tell from one they kept stands in its class
// Delay      a command delay that was kept and the scan's delay are one thing, "delay"; where the command side was
//            asked and none was kept, the scan's delay is none
// Threads    pure function

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/infer/decision/decision_facts.hpp"
#include "engine/infer/decision/loop_facts.hpp"

namespace torquescope {

struct StandingNames {
  bool by_loop = false;           // simulations decided
  bool drops_effects = false;     // of the scan
  bool of_other_model = false;    // than the scan's: numbers and classes are those of simulations
  std::vector<bool> effects{};    // of each that the scan took
  std::vector<KeptMove> added{};  // of the ladder, without an effect that the scan took
  bool has_delay = false;
  std::optional<LoopNumber> command_delay{};  // what the ladder found of it

  bool any() const;
};

StandingNames standing_names(DecisionFacts const& scan, LoopFacts const& loop);
// the scan's facts, where what simulations call chance is chance
DecisionFacts judged_in_loop(DecisionFacts scan, LoopFacts const& loop);

}  // namespace torquescope
