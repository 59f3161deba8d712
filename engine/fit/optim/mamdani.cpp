#include "engine/fit/optim/mamdani.hpp"

#include <algorithm>
#include <utility>

namespace torquescope {

SetLevels clip_levels(SetLevels const& first, SetLevels const& second) {
  auto const [a_small, a_middle, a_big] = first;
  auto const [b_small, b_middle, b_big] = second;
  double const b_any = std::max({b_small, b_middle, b_big});
  double const a_any = std::max({a_small, a_middle, a_big});
  return {std::min(a_small, b_small),
          std::max(std::min(a_middle, std::max(b_small, b_middle)), std::min(b_middle, std::max(a_small, a_middle))),
          std::max(std::min(a_big, b_any), std::min(a_any, b_big))};
}

MamdaniSystem::MamdaniSystem(FuzzyVariable first, FuzzyVariable second, FuzzyVariable output,
                             Defuzzification defuzzification, std::size_t centroid_points)
    : first_(std::move(first)),
      second_(std::move(second)),
      output_(std::move(output)),
      defuzzification_(defuzzification),
      grid_centroid_(output_, centroid_points) {}

double MamdaniSystem::operator()(double first_level, double second_level) const {
  auto const levels = clip_levels(memberships(first_, first_level), memberships(second_, second_level));
  switch (defuzzification_) {
    case Defuzzification::centroid_closed:
      return closed_centroid(output_, levels);
    case Defuzzification::weighted_average:
      return weighted_average(output_, levels);
    case Defuzzification::centroid:
      break;
  }
  return grid_centroid_(levels);
}

}  // namespace torquescope
