#include "engine/infer/locate/largest_parts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace torquescope {
namespace {

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
// most. Any effect of the motion leaves most where the torque has most, and noise is everywhere: what is beyond the
// replicates must surprise for the stretch's share of the torque and for its width
ToldPart told_stretch(MapAxis const& axis, MismatchRegion const& region) {
  std::vector<MapCell> cells;
  double energy = 0.0, beyond = 0.0;
  auto const energy_of = [](MapCell const& cell, double amplitude) {  // up to a factor
    return cell.samples > 0 ? amplitude * amplitude * static_cast<double>(cell.samples) : 0.0;
  };
  auto const beyond_of = [&](MapCell const& cell) {
    return std::max(0.0, energy_of(cell, cell.mean_residual) - energy_of(cell, cell.replicate_mean));
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
