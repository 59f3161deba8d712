#include "engine/diagnose/own_motion.hpp"

namespace torquescope {

std::optional<RefinedEffect> refine_on_own_motion(ModelStage const& stage, EffectScan const& scan, ShapeSearch search,
                                                  int threads) {
  constexpr int times_longer = 3;  // parts that knock have many shapes that are nearly right
  if (!scan.effect->has_memory() || scan.effect->n_shape() == 0) return std::nullopt;
  CandidateColumns const columns(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters(),
                                 CandidateColumns::none, DrivenBy::recording);
  search.generations *= times_longer;
  return refine_plausible(columns, scan, stage.mismatch(), search, threads);
}

}  // namespace torquescope
