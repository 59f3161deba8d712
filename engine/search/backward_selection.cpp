#include "engine/search/backward_selection.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/search/equivalent_effects.hpp"
#include "engine/search/joint_refinement.hpp"

namespace torquescope {
namespace {

// energy of effect i that the rest of the model cannot take over
double own_energy(ModelStage const& stage, std::size_t i) {
  CandidateColumns const others(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters(), i);
  auto const& shaped = stage.model().effects()[i];
  OrthonormalGroup const group = others.group(*shaped.effect, shaped.shape);
  auto const first = static_cast<Eigen::Index>(stage.model().first_parameter(i));
  Eigen::VectorXd const linear =
      stage.parameters().segment(first, static_cast<Eigen::Index>(shaped.effect->n_linear()));
  return (group.r * linear).squaredNorm();
}

void drop_superfluous(StageSetting const& setting, Selection& selection) {
  while (selection.accepted.size() > 1) {
    ModelStage const& stage = *selection.final;
    std::size_t weakest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < selection.accepted.size(); ++i) {
      double const own = own_energy(stage, i);
      if (own < least) {
        least = own;
        weakest = i;
      }
    }
    if (least >= least_share_of_whole * selection.whole()) return;
    auto const at = static_cast<std::ptrdiff_t>(weakest);
    std::vector<ShapedEffect> effects = stage.model().effects();
    effects.erase(effects.begin() + at);
    auto next = refined_stage(setting, stage.reference(), std::move(effects));
    if (!next) return;
    selection.rejected.push_back({selection.accepted[weakest].effect, "superfluous beside the effects named after it"});
    selection.accepted.erase(selection.accepted.begin() + at);
    selection.final = std::make_shared<ModelStage const>(std::move(*next));
  }
}

std::vector<Effect const*> relatives_of(Effect const* effect, Selection const& selection) {
  std::vector<Effect const*> relatives;
  for (auto const& scan : selection.first_scan)
    if (scan.is_testable && !selection.has_accepted(scan.effect) && scan.effect->family() == effect->family())
      relatives.push_back(scan.effect);
  return relatives;
}

// what is known of the other from the step at which nothing was named; its gain is that of the first, as much larger
AcceptedEffect taken_over(AcceptedEffect const& from, Rival const& rival, Selection const& selection) {
  AcceptedEffect taken;
  taken.effect = rival.effect;
  taken.gain = from.gain * rival.gain_ratio;
  taken.cv_gain = taken.region_gain = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < selection.first_scan.size(); ++k) {
    if (selection.first_scan[k].effect != rival.effect) continue;
    taken.scan = selection.first_scan[k];
    taken.q = selection.first_q[k];
  }
  return taken;
}

void swap_within_families(StageSetting const& setting, SelectionOptions const& options, Selection& selection) {
  constexpr double clearly_more = 1.03;
  ShapeSearch const search = shape_search(options.shape_optimiser, setting.seed);
  for (std::size_t i = 0; i < selection.accepted.size(); ++i) {
    ModelStage const& stage = *selection.final;
    auto const relatives = relatives_of(selection.accepted[i].effect, selection);
    auto const rivals = rivals_of(stage, i, relatives, search, setting.threads);
    if (rivals.empty() || rivals.front().gain_ratio < clearly_more) continue;
    std::vector<ShapedEffect> effects = stage.model().effects();
    effects[i] = {rivals.front().effect, rivals.front().shape};
    auto next = refined_stage(setting, stage.reference(), std::move(effects));
    if (!next || next->mismatch().squaredNorm() >= stage.mismatch().squaredNorm()) continue;
    selection.rejected.push_back({selection.accepted[i].effect, "explains less than " + rivals.front().effect->name() +
                                                                    " beside the effects named after it"});
    selection.accepted[i] = taken_over(selection.accepted[i], rivals.front(), selection);
    selection.final = std::make_shared<ModelStage const>(std::move(*next));
  }
}

}  // namespace

void revise_selection(StageSetting const& setting, SelectionOptions const& options, Selection& selection) {
  drop_superfluous(setting, selection);
  if (selection.accepted.size() > 1) swap_within_families(setting, options, selection);
}

}  // namespace torquescope
