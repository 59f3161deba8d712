#include "engine/infer/search/blocked_mismatch.hpp"

#include "engine/fit/statistics/blocked_cv.hpp"

namespace torquescope {

BlockedMismatch blocked_mismatch(ModelStage const& stage) {
  CandidateColumns const columns(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters());
  double const energy = blocked_residual_energy(stage.mismatch(), columns.model_columns(), guard_rows(*stage.pipeline));
  return {energy, energy - stage.energy.noise};
}

}  // namespace torquescope
