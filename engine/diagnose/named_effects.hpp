#pragma once
// What is reported of every accepted effect: evidence, parameters with intervals, where it acts, what it cannot be told
// from.
//
// Waves      a second wave of one kind belongs to the first: one name, both waves' parameters, the lower order first
// Threads    spreads the refinement of rivals over `threads`; same bits for any number

#include <cstddef>
#include <span>
#include <vector>

#include "engine/infer/moving_rows/confidence_set.hpp"
#include "engine/infer/search/selection.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

struct NamedEffects {
  std::vector<NamedEffect> effects{};
  std::vector<ParameterEstimate> parameters{};  // of the baseline beside them, then of each accepted effect
  std::vector<std::size_t> place{};             // of each accepted effect among `effects`
};

// evidence: of the final stage; catalogue: effects that may be rivals of an accepted one (confidence_set.hpp)
NamedEffects name_effects(Selection const& selection, Evidence const& evidence,
                          std::span<Effect const* const> catalogue, DecisionLevels const& levels,
                          RefinementSetting const& setting);

}  // namespace torquescope
