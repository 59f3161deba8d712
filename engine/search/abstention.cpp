#include "engine/search/abstention.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/search/torque_itself.hpp"

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

// of the first excess: a level of friction that falls once and for all is found and removed, and the weighed rest is
// still most of it
double share_in_torque_itself(ModelStage const& baseline, ModelStage const& final) {
  double const first = excess_in_torque_itself(baseline);
  return first > 0.0 ? std::max(0.0, excess_in_torque_itself(final)) / first : 1.0;
}

// What it tells that a share of the energy lies within a share of the axis: the information (Kullback, Leibler) against
// energy that is spread evenly; 0 where there is less than that. What spans its axis says nothing however much it holds
double told_by(double energy, double even) {
  if (!(energy > even) || !(even > 0.0)) return 0.0;
  double const outside = energy < 1.0 ? (1.0 - energy) * std::log((1.0 - energy) / (1.0 - even)) : 0.0;
  return energy * std::log(energy / even) + outside;
}

struct ToldPart {
  double told = 0.0;
  UnexplainedPart part{};
};

// A spectrum has one sign, so that its regions grow together over most of it: told is the stretch of one that tells
// most. Any law of the motion leaves most where the torque has most, and noise is everywhere: what is beyond the twins
// must surprise for the stretch's share of the torque and for its width
ToldPart told_stretch(MapAxis const& axis, MismatchRegion const& region) {
  std::vector<MapCell> cells;
  double energy = 0.0, beyond = 0.0;
  auto const energy_of = [](MapCell const& cell, double amplitude) {  // up to a factor
    return cell.samples > 0 ? amplitude * amplitude * static_cast<double>(cell.samples) : 0.0;
  };
  auto const beyond_of = [&](MapCell const& cell) {
    return std::max(0.0, energy_of(cell, cell.mean_residual) - energy_of(cell, cell.twin_mean));
  };
  for (MapCell const& cell : axis.cells)
    if (cell.from >= region.where.from && cell.to <= region.where.to) {
      cells.push_back(cell);
      energy += energy_of(cell, cell.mean_residual);
      beyond += beyond_of(cell);
    }
  ToldPart best;
  if (!(beyond > 0.0)) return best;
  for (std::size_t first = 0; first < cells.size(); ++first) {
    double held = 0.0, held_beyond = 0.0, of_torque = 0.0;
    for (std::size_t last = first; last < cells.size(); ++last) {
      held += energy_of(cells[last], cells[last].mean_residual);
      held_beyond += beyond_of(cells[last]);
      if (cells[last].samples > 0) of_torque += cells[last].torque_share;
      double const share = region.energy_share * held / energy;
      double const width = static_cast<double>(last - first + 1) / static_cast<double>(axis.cells.size());
      double const surplus = region.energy_share * region.repeatable_share * held_beyond / beyond;
      double const told = std::min(told_by(surplus, width), told_by(surplus, of_torque));
      if (told > best.told) best = {told, {{axis.axis, cells[first].from, cells[last].to, region.where.unit}, share}};
    }
  }
  return best;
}

}  // namespace

Remainder judge_remainder(Selection const& selection, ModelStage const& final) {
  Remainder result;
  if (!selection.is_gate_open) return result;
  double const first = selection.whole();
  result.share = std::max(0.0, final.energy.excess) / first;
  result.is_significant =
      final.energy.z > smallest_z && mismatch_share(final) > smallest_mismatch_share && result.share > worth_a_word;
  bool const explains_most = 1.0 - result.share >= enough_named;
  result.is_named_enough = explains_most || final.energy.z <= surely_left_z;
  result.is_most_left = !selection.accepted.empty() && result.share > most_of_the_whole &&
                        final.energy.z > surely_left_z &&
                        share_in_torque_itself(*selection.baseline, final) > most_of_the_whole;
  result.is_unexplained = selection.accepted.empty() || result.is_most_left;
  if (!result.is_significant) return result;
  CandidateColumns const columns(*final.pipeline, final.comparison, final.reference(), final.parameters());
  result.axes = generic_axes(columns, final.energy.excess);
  if (!explains_most && result.axes.front().share > some_structure) result.is_unexplained = true;
  // weaker axes follow the strongest one: on a short motion everything is a function of everything
  auto const& strongest = result.axes.front();
  if (strongest.share > most_of_what_is_left && !is_axis_of(final.model(), strongest)) result.is_unexplained = true;
  return result;
}

std::vector<UnexplainedPart> largest_parts(std::vector<MapAxis> const& map) {
  constexpr std::size_t enough = 5;
  std::vector<ToldPart> parts;
  for (auto const& axis : map)
    for (auto const& region : axis.regions)
      parts.push_back(axis.is_spectrum ? told_stretch(axis, region)
                                       : ToldPart{told_by(region.energy_share, region.time_share),
                                                  {region.where, region.energy_share}});
  std::erase_if(parts, [](ToldPart const& one) { return !(one.told > 0.0); });
  std::stable_sort(parts.begin(), parts.end(), [](auto const& a, auto const& b) { return a.told > b.told; });
  std::vector<UnexplainedPart> largest;
  for (std::size_t i = 0; i < std::min(enough, parts.size()); ++i) largest.push_back(parts[i].part);
  return largest;
}

}  // namespace torquescope
