#include "engine/infer/moving_rows/weight_in_place.hpp"

#include <algorithm>

#include "engine/infer/search/joint_refinement.hpp"

namespace torquescope {
namespace {

// what is told of the law is what the first step found of it; its gains are those of the law that it stands for, as far
// as it has them
void put_in_place(Selection& selection, std::size_t i, RivalLaw const& weight) {
  auto& accepted = selection.accepted[i];
  auto const first = std::find_if(selection.first_scan.begin(), selection.first_scan.end(),
                                  [&](EffectScan const& one) { return one.effect == weight.effect; });
  if (first != selection.first_scan.end()) {
    accepted.scan = *first;
    accepted.q = first->p;
  }
  accepted.effect = accepted.scan.effect = weight.effect;
  accepted.scan.shape = weight.shape;
  accepted.gain *= weight.gain_ratio;
  accepted.cv_gain *= weight.gain_ratio;
}

}  // namespace

std::optional<WithWeight> with_weight_in_place(StageSetting const& setting, Selection const& selection,
                                               Evidence const& evidence, std::span<Effect const* const> candidates,
                                               DecisionLevels const& levels, RefinementSetting const& refinement) {
  auto const weight =
      std::find_if(candidates.begin(), candidates.end(), [](Effect const* effect) { return effect->is_weight(); });
  if (weight == candidates.end() || selection.has_accepted(*weight)) return {};
  for (std::size_t i = 0; i < selection.accepted.size(); ++i) {
    if (selection.accepted[i].effect->family() != EffectFamily::static_position) continue;
    auto const rival = confidence_set(evidence, i, std::span(&*weight, 1), levels, refinement);
    if (rival.empty()) continue;
    std::vector<ShapedEffect> effects = selection.final->model().effects();
    effects[i] = {rival.front().effect, rival.front().shape};
    auto stage = refined_stage(setting, selection.final->reference(), std::move(effects));
    if (!stage) continue;
    Selection with = selection;
    put_in_place(with, i, rival.front());
    return WithWeight{std::move(with), std::move(*stage)};
  }
  return {};
}

}  // namespace torquescope
