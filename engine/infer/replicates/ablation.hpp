#pragma once
// Parts of the method that can be taken away or misled, to see what they bring: for the scoreboard, never for use.
//
// Units      twin_noise: factor on everything random in the twins but the encoder (measurement, disturbance, wandering
//            friction), after it was measured: what happens when a user states the noise wrongly
// Threads    plain record, free functions

#include <string>
#include <vector>

#include "engine/infer/replicates/baseline_twin.hpp"
#include "engine/infer/replicates/null_kind.hpp"

namespace torquescope {

struct Ablation {
  NullKind null = NullKind::twins;
  bool indirect_inference = true;  // false: twins of the least-squares baseline, bias and all
  double twin_noise = 1.0;
  bool whitening = true;  // false: rows count alike, whatever their noise

  bool changes_twins() const { return !indirect_inference || twin_noise != 1.0; }
};

// the twin as this ablation wants it; nothing changes without one
// Errors     Error 65 as make_twin_joint
void ablate_twin(BaselineTwin& made, RecordPipeline const& pipeline, Ablation const& ablation);

}  // namespace torquescope
