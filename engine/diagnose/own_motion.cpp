#include "engine/diagnose/own_motion.hpp"

namespace torquescope {

BothMotions::BothMotions(ModelStage const& stage)
    : twin(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters()),
      recording(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters(), CandidateColumns::none,
                DrivenBy::recording) {}

std::optional<RefinedEffect> refine_on_own_motion(CandidateColumns const& own, EffectScan const& scan,
                                                  Eigen::VectorXd const& mismatch, ShapeSearch search, int threads) {
  constexpr int times_longer = 3;  // parts that ring or knock have many shapes that are nearly right
  if (!scan.effect->has_memory()) return std::nullopt;
  if (scan.effect->n_shape() > 2) search.generations *= times_longer;
  return refine_plausible(own, scan, mismatch, search, threads);
}

}  // namespace torquescope
