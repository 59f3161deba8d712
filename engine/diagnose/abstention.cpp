#include "engine/diagnose/abstention.hpp"

#include <algorithm>
#include <utility>

namespace torquescope {
namespace {

constexpr double worth_a_word = 0.03;  // of the first excess
constexpr double smallest_z = 5.0;
constexpr double most_of_what_is_left = 0.5;
constexpr double enough_named = 2.0 / 3.0;
constexpr double some_structure = 0.2;
constexpr double surely_left_z = 3.0, most_of_the_whole = 0.5;

bool is_axis_of(JointModel const& model, GenericAxis const& axis) {
  return std::any_of(model.effects().begin(), model.effects().end(), [&](ShapedEffect const& one) {
    auto const& own = one.effect->signature();
    return std::find_first_of(own.begin(), own.end(), axis.axes.begin(), axis.axes.end()) != own.end();
  });
}

// Of the first excess, in the torque itself. Weighed rows make little of what goes with friction that may wander: a level of friction
// that falls once and for all is found and removed, and the weighed rest is still most of it
double share_in_torque_itself(ModelStage const& baseline, ModelStage const& final) {
  auto const excess_of = [](ModelStage const& stage) {
    return mismatch_energy(in_torque_itself(stage.comparison.rows)).excess;
  };
  double const first = excess_of(baseline);
  return first > 0.0 ? std::max(0.0, excess_of(final)) / first : 1.0;
}

}  // namespace

Remainder judge_remainder(Selection const& selection, ModelStage const& final) {
  Remainder result;
  if (!selection.is_gate_open) return result;
  double const first = selection.whole();
  result.share = std::max(0.0, final.energy.excess) / first;
  result.is_significant =
      final.energy.z > smallest_z && mismatch_share(final) > smallest_mismatch_share && result.share > worth_a_word;
  result.is_most_left = !selection.accepted.empty() && result.share > most_of_the_whole &&
                        final.energy.z > surely_left_z &&
                        share_in_torque_itself(*selection.baseline, final) > most_of_the_whole;
  result.is_unexplained = selection.accepted.empty() || result.is_most_left;
  if (!result.is_significant) return result;
  CandidateColumns const columns(*final.pipeline, final.comparison, final.reference(), final.parameters());
  result.axes = generic_axes(columns, final.energy.excess);
  bool const is_named_enough = 1.0 - result.share >= enough_named;
  if (!is_named_enough && result.axes.front().share > some_structure) result.is_unexplained = true;
  // weaker axes follow the strongest one: on a short motion everything is a function of everything
  auto const& strongest = result.axes.front();
  if (strongest.share > most_of_what_is_left && !is_axis_of(final.model(), strongest)) result.is_unexplained = true;
  return result;
}

std::vector<UnexplainedPart> largest_parts(std::vector<MapAxis> const& map) {
  constexpr std::size_t enough = 5;
  std::vector<std::pair<double, UnexplainedPart>> parts;
  for (auto const& axis : map)
    for (auto const& region : axis.regions)
      parts.push_back({axis.energy_share * region.energy_share, {region.where, region.energy_share}});
  std::stable_sort(parts.begin(), parts.end(), [](auto const& a, auto const& b) { return a.first > b.first; });
  std::vector<UnexplainedPart> largest;
  for (std::size_t i = 0; i < std::min(enough, parts.size()); ++i) largest.push_back(parts[i].second);
  return largest;
}

}  // namespace torquescope
