#pragma once
// The search: take the law that predicts most of what is left, refit, make replicates of the new model, repeat.
//
// Step       of the laws beyond chance over the catalogue, above the tolerance and no worse on unseen rows, the one
//            with the largest gain; of those that no paired test tells from it the one with fewest parameters
// Then       laws whose removal does not raise D beyond chance are dropped
// Phases     laws of the motion until none is left; clock-bound laws (effects/carry_over.hpp) after them, and only
//            while the model is not adequate; they stay only when it is adequate with them. Where laws of the motion
//            leave most of the mismatch, clock-bound laws are first asked without them
// Threads    as the stages
// Source     engine/infer/moving_rows/THEORY.md, The search

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/infer/moving_rows/adequacy.hpp"
#include "engine/infer/moving_rows/candidate_evidence.hpp"
#include "engine/infer/search/selection.hpp"

namespace torquescope {

// one model on the way
struct SearchState {
  Selection selection{};  // accepted laws, stages, refusals
  std::shared_ptr<Evidence const> evidence{};
  Adequacy adequacy{};
};

struct StepwiseSearch {
  std::vector<SearchState> states{};  // the baseline first, then after each step that was taken
  StageSetting setting;               // as the last state's stages were made
  SearchState const& end() const { return states.back(); }
};

// Errors: Error 65, the baseline cannot be fitted or simulated
StepwiseSearch search_stepwise(StageSetting const& setting, SelectionOptions const& options,
                               DecisionLevels const& levels, OtherRecordings const& others, StageSink const& progress);

}  // namespace torquescope
