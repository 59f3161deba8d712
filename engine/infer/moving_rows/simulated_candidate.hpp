#pragma once
// The model with a candidate, simulated: whether replicates with it take away what its projection promises.
//
// First      a few replicates; those that leave as much as without it end there
// Shape      corrected by replicates (joint_refinement.hpp), unless it then predicts worse than the candidate's own
// Others     other shapes of the candidate are simulated where the law shapes its own motion, or where the best one
//            cannot be simulated; the one that leaves least in left-out folds is taken
// Threads    spreads replicates over the setting's workers; same bits for any number
// Source     indirect inference: Gourieroux, Monfort, Renault 1993, doi:10.1002/jae.3950080507

#include <optional>

#include "engine/infer/moving_rows/refined_candidates.hpp"

namespace torquescope {

// evidence: of the model without it; least_taken: energy that is beyond chance. Nothing where it cannot be simulated
std::optional<ModelStage> simulated(StageSetting const& setting, Evidence const& evidence,
                                    RefinedCandidate const& candidate, double least_taken);

}  // namespace torquescope
