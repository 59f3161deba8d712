#include "engine/unseen/unseen_selection.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "engine/search/joint_refinement.hpp"
#include "engine/unseen/unseen_refutation.hpp"

namespace torquescope {
namespace {

// no more than it does in twins that have it
bool is_as_in_twins(StageSetting const& setting, std::span<Recording const> unseen, Selection const& selection,
                    std::size_t effect, PredictionEnergies const& found) {
  std::vector<std::vector<PredictionEnergies>> twins;
  for (auto const& recording : unseen) twins.push_back(twins_without(recording, setting, *selection.final, effect));
  return found.share() >= least_by_chance(over_recordings(twins));
}

// over all recordings, one per effect
struct Without {
  std::vector<PredictionEnergies> effects;
  double residual = 0.0;  // of the whole model
};

Without without_each(StageSetting const& setting, std::span<Recording const> unseen, Selection const& selection) {
  Without sum{std::vector<PredictionEnergies>(selection.accepted.size())};
  for (auto const& recording : unseen) {
    auto const prediction = predict_unseen(recording, setting, *selection.baseline, *selection.final);
    sum.residual += prediction.energies.after;
    for (std::size_t i = 0; i < sum.effects.size(); ++i) sum.effects[i] += prediction.by_effect[i];
  }
  return sum;
}

// the effect that spoils most, by what it gains for each unit of energy it moves; events too, for their torque is left
// out on both sides, and what they did to the parameters beside them is not
std::optional<std::size_t> worst_spoiler(StageSetting const& setting, std::span<Recording const> unseen,
                                         Selection const& selection) {
  Without const sum = without_each(setting, unseen, selection);
  std::optional<std::size_t> worst;
  double least = 0.0;
  for (std::size_t i = 0; i < sum.effects.size(); ++i) {
    PredictionEnergies const& found = sum.effects[i];
    if (found.moved < enough_moved * sum.residual) continue;
    if (found.gain() >= least * found.moved || is_as_in_twins(setting, unseen, selection, i, found)) continue;
    least = found.gain() / found.moved;
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
