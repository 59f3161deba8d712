#include "engine/diagnose/unseen_selection.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "engine/diagnose/joint_refinement.hpp"
#include "engine/diagnose/unseen_refutation.hpp"

namespace torquescope {
namespace {

// the effect that spoils most, by what it gains for each unit of energy it moves
std::optional<std::size_t> worst_spoiler(StageSetting const& setting, std::span<Recording const> unseen,
                                         Selection const& selection) {
  std::vector<UnseenWithout> sum(selection.accepted.size());
  double residual = 0.0;
  for (auto const& recording : unseen) {
    auto const prediction = predict_unseen(recording, setting, *selection.baseline, *selection.final);
    residual += prediction.after_energy;
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i].gain += prediction.without[i].gain;
      sum[i].moved += prediction.without[i].moved;
    }
  }
  std::optional<std::size_t> worst;
  double least = 0.0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (!must_carry_over(*selection.accepted[i].effect) || sum[i].moved < enough_moved * residual) continue;
    if (sum[i].gain >= least * sum[i].moved) continue;
    least = sum[i].gain / sum[i].moved;
    worst = i;
  }
  return worst;
}

}  // namespace

void drop_spoilers(StageSetting const& setting, std::span<Recording const> unseen, Selection& selection,
                   Remainder& remainder) {
  while (selection.accepted.size() > 1 && !remainder.is_unexplained) {
    auto const spoiler = worst_spoiler(setting, unseen, selection);
    if (!spoiler) return;
    auto const at = static_cast<std::ptrdiff_t>(*spoiler);
    std::vector<ShapedEffect> effects = selection.final->model().effects();
    effects.erase(effects.begin() + at);
    auto next = refined_stage(setting, selection.final->reference(), std::move(effects));
    if (!next) return;
    Selection without = selection;
    without.rejected.push_back({selection.accepted[*spoiler].effect, "spoils the prediction of unseen data"});
    without.accepted.erase(without.accepted.begin() + at);
    without.final = std::make_shared<ModelStage const>(std::move(*next));
    Remainder const left = judge_remainder(without, *without.final);
    if (left.is_unexplained) return;
    selection = std::move(without);
    remainder = left;
  }
}

}  // namespace torquescope
