#include "engine/infer/search/joint_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/fit/statistics/scaled_solution.hpp"
#include "engine/infer/search/parameter_intervals.hpp"
#include "engine/infer/search/shape_grid.hpp"

namespace torquescope {
namespace {

struct ShapeSteps {
  std::vector<ShapedEffect> effects;
  bool is_small = true;
};

ShapeSteps stepped(ModelStage const& stage) {
  CandidateColumns const columns(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters());
  ShapeSteps result{stage.model().effects()};
  Eigen::Index const n_shapes = columns.tangents().cols();
  if (n_shapes == 0) return result;
  Eigen::VectorXd const step = Eigen::VectorXd(solve_scaled(columns.with_tangents(), stage.mismatch())).tail(n_shapes);
  Eigen::VectorXd const std = parameter_deviations(stage, columns).tail(n_shapes);

  constexpr double small = 0.5;  // standard deviations
  Eigen::Index at = 0;
  for (auto& shaped : result.effects) {
    auto const ranges = shaped.effect->shape_bounds(columns.scales());
    for (std::size_t k = 0; k < shaped.shape.size(); ++k, ++at) {
      // a linear step must not leave the neighbourhood it was made in
      double const unit = to_unit(ranges[k], shaped.shape[k]);
      double next = shaped.shape[k] + step[at];
      if (ranges[k].spacing == Spacing::logarithmic) next = std::max(next, 1e-3 * shaped.shape[k]);  // not below 0
      next = to_unit(ranges[k], next);
      constexpr double longest = 0.1;  // of the bounds
      double const moved = std::clamp(std::isfinite(next) ? next : unit, unit - longest, unit + longest);
      double const value = from_unit(ranges[k], moved);
      if (std::abs(value - shaped.shape[k]) > small * std[at]) result.is_small = false;
      shaped.shape[k] = value;
    }
  }
  return result;
}

}  // namespace

std::optional<ModelStage> refined_draft(StageSetting const& setting, BaselineReference const& reference,
                                        std::vector<ShapedEffect> effects) {
  constexpr int most_rounds = 4;
  StageSetting draft = setting;
  draft.twins = std::min(setting.twins, draft_twins);
  auto best = make_stage(draft, JointModel(setting.regressor, reference, std::move(effects)));
  for (int round = 0; best && round < most_rounds; ++round) {
    ShapeSteps steps = stepped(*best);
    if (steps.is_small) break;
    // a step in shape changes no noise
    draft.levels = levels_of(*best->twin);
    auto next = make_stage(draft, JointModel(setting.regressor, best->reference(), std::move(steps.effects)));
    if (!next || next->mismatch().squaredNorm() >= best->mismatch().squaredNorm()) break;
    best = std::move(next);
  }
  return best;
}

std::optional<ModelStage> refined_stage(StageSetting const& setting, BaselineReference const& reference,
                                        std::vector<ShapedEffect> effects) {
  auto const draft = refined_draft(setting, reference, std::move(effects));
  if (!draft) return std::nullopt;
  StageSetting whole = setting;
  whole.levels = levels_of(*draft->twin);
  return make_stage(whole, draft->model());
}

}  // namespace torquescope
