#pragma once
// What a model leaves on blocks of time that it was not fitted to: what a cross-validated gain is a share of.
//
// Why        of the mismatch itself a gain on unseen blocks can be more than all of it: there the model alone predicts
//            worse than on the rows that it was fitted to
// Units      energy of the stage's rows
// Threads    free function

#include "engine/infer/search/model_stage.hpp"

namespace torquescope {

struct BlockedMismatch {
  double energy = 0.0;
  double excess = 0.0;  // of it, beyond noise; may be below 0 by chance
};

BlockedMismatch blocked_mismatch(ModelStage const& stage);

}  // namespace torquescope
