#include "engine/infer/moving_rows/simulated_candidate.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/fit/statistics/blocked_cv.hpp"
#include "engine/infer/search/joint_refinement.hpp"
#include "engine/infer/search/selection.hpp"

namespace torquescope {
namespace {

double left_out_energy(ModelStage const& stage) {
  return blocked_residual_energy(stage.mismatch(), stage.comparison.common.columns, guard_rows(*stage.pipeline));
}

bool predicts_less(Evidence const& evidence, RefinedCandidate const& candidate, std::vector<double> const& shape) {
  if (shape.empty()) return false;
  auto const gain =
      evidence.gains(*candidate.evidence.scan.effect, {shape}, candidate.evidence.folds, candidate.driven_by);
  return gain.front().total()[0] < candidate.evidence.scan.gain;
}

// a few replicates tell whether it is worth more
std::optional<ModelStage> simulated_at(StageSetting const& setting, Evidence const& evidence,
                                       RefinedCandidate const& candidate, std::vector<double> const& shape,
                                       double least_taken) {
  ModelStage const& before = evidence.stage();
  std::vector<ShapedEffect> effects = before.model().effects();
  effects.push_back({candidate.evidence.scan.effect, shape});
  StageSetting few = setting;
  few.twins = std::min(few.twins, twin_lanes);
  auto first = make_stage(few, JointModel(setting.regressor, before.reference(), effects));
  if (!first || energy_about_true_mean(before) - energy_about_true_mean(*first) < least_taken) return first;
  // of this very model: more replicates change no level
  StageSetting draft = setting;
  draft.levels = levels_of(*first->twin);
  first.reset();  // nobody asks it again, and of a long recording a stage is large
  auto moved = refined_draft(draft, before.reference(), effects);
  if (moved && !predicts_less(evidence, candidate, moved->model().effects().back().shape)) return moved;
  draft.twins = std::min(draft.twins, draft_twins);
  auto stays = make_stage(draft, JointModel(setting.regressor, before.reference(), std::move(effects)));
  bool const is_moved_better = moved && (!stays || left_out_energy(*moved) < left_out_energy(*stays));
  return is_moved_better ? std::move(moved) : std::move(stays);
}

}  // namespace

std::optional<ModelStage> simulated(StageSetting const& setting, Evidence const& evidence,
                                    RefinedCandidate const& candidate, double least_taken) {
  auto best = simulated_at(setting, evidence, candidate, candidate.shape, least_taken);
  for (auto const& shape : candidate.other_shapes) {
    if (best && !candidate.evidence.scan.effect->has_inertia()) break;
    auto other = simulated_at(setting, evidence, candidate, shape, least_taken);
    if (other && (!best || left_out_energy(*other) < left_out_energy(*best))) best = std::move(other);
  }
  return best;
}

}  // namespace torquescope
