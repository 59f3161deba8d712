#include "engine/diagnose/own_motion.hpp"

#include <vector>

namespace torquescope {

BothMotions::BothMotions(ModelStage const& stage)
    : twin(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters()),
      recording(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters(), CandidateColumns::none,
                DrivenBy::recording) {}

std::optional<RefinedEffect> refine_on_own_motion(CandidateColumns const& own, EffectScan const& scan,
                                                  Eigen::VectorXd const& mismatch, OwnMotionSearch const& how,
                                                  int threads) {
  if (!scan.effect->has_memory()) return std::nullopt;
  std::vector<ShapeSearch> searches{shape_search(how.optimiser, how.seed)};
  if (scan.effect->n_shape() > 2) {
    // parts that ring or knock, and friction with three shapes, have many that are nearly right
    constexpr int times_longer = 3;
    searches.front().generations *= times_longer;
    // friction with a memory has one maximum
    if (how.everywhere && scan.effect->has_inertia()) {
      auto const members = 8 * static_cast<std::int64_t>(scan.effect->n_shape());
      searches.push_back(shape_search(how.optimiser, how.seed, members));
      searches.back().generations = 40;
      searches.back().everywhere = true;
    }
  }
  auto best = refine_plausible(own, scan, mismatch, searches, threads);
  auto grid = how.everywhere ? resonance_grid(*scan.effect, own.scales()) : std::nullopt;
  if (!grid) return best;
  EffectScan fine;
  fine.effect = scan.effect;
  fine.grid = std::move(*grid);
  auto ringing = refine_plausible(own, fine, mismatch, {&searches.front(), 1}, threads);
  if (!ringing || (best && ringing->gain <= best->gain)) return best;
  if (best) ringing->evaluations += best->evaluations;
  return ringing;
}

}  // namespace torquescope
