#include "engine/infer/search/own_motion.hpp"

#include <utility>

namespace torquescope {

BothMotions::BothMotions(ModelStage const& stage, std::size_t without)
    : twin(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters(), without),
      recording(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters(), without,
                DrivenBy::recording) {}

OwnMotionShapes::OwnMotionShapes(CandidateColumns const& own, EffectScan const& scan, Eigen::VectorXd const& mismatch,
                                 std::string optimiser, std::uint64_t seed, int threads)
    : own_(own), scan_(scan), mismatch_(mismatch), optimiser_(std::move(optimiser)), seed_(seed), threads_(threads) {}

ShapeSearch OwnMotionShapes::longer_search() const {
  ShapeSearch search = shape_search(optimiser_, seed_);
  // parts that ring or knock, and friction with three shapes, have many that are nearly right
  constexpr int times_longer = 3;
  if (scan_.effect->n_shape() > 2) search.generations *= times_longer;
  return search;
}

std::optional<RefinedEffect> const& OwnMotionShapes::nearby() {
  if (std::exchange(is_made_, true) || !scan_.effect->has_memory()) return nearby_;
  point_ = best_plausible_point(own_, scan_, mismatch_, threads_);
  if (point_) nearby_ = refine_plausible_from(own_, scan_, *point_, mismatch_, longer_search(), threads_);
  return nearby_;
}

std::optional<RefinedEffect> OwnMotionShapes::everywhere() {
  auto best = nearby();
  auto const& effect = *scan_.effect;
  if (!effect.has_memory()) return best;
  // friction with a memory has one maximum
  if (best && effect.n_shape() > 2 && effect.has_inertia()) {
    auto whole = shape_search(optimiser_, seed_, 8 * static_cast<std::int64_t>(effect.n_shape()));
    whole.generations = 40;
    whole.everywhere = true;
    auto found = refine_plausible_from(own_, scan_, *point_, mismatch_, whole, threads_);
    std::int64_t const evaluations = best->evaluations + found.evaluations;
    if (found.gain > best->gain) best = std::move(found);
    best->evaluations = evaluations;
  }
  auto grid = resonance_grid(effect, own_.scales());
  if (!grid) return best;
  EffectScan fine;
  fine.effect = &effect;
  fine.grid = std::move(*grid);
  auto ringing = refine_plausible(own_, fine, mismatch_, longer_search(), threads_);
  if (!ringing || (best && ringing->gain <= best->gain)) return best;
  if (best) ringing->evaluations += best->evaluations;
  return ringing;
}

}  // namespace torquescope
