#include "engine/infer/decision/shape_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace torquescope {
namespace {

constexpr double share_of_resolution = 0.7;

// a long recording resolves more waves than anybody can look at: the fastest ones are left out
ParameterRange affordable(ParameterRange range, EffectParameter const& parameter, JointScales const& scales) {
  if (!parameter.is_order() && !parameter.is_frequency()) return range;
  double const gap = share_of_resolution * bound_value({1.0, parameter.lower.to}, scales);
  range.upper = std::min(range.upper, range.lower + static_cast<double>(most_waves - 1) * gap);
  return range;
}

bool rings(Effect const& effect) {
  auto const& parameters = effect.parameters();
  return std::any_of(parameters.begin(), parameters.end(), [](auto const& one) { return one.is_resonance; });
}

// with no more than this factor from one to the next
std::size_t points_apart(ParameterRange const& range, double factor) {
  return static_cast<std::size_t>(std::ceil(std::log(range.upper / range.lower) / std::log(factor))) + 1;
}

std::size_t points_for(EffectParameter const& parameter, ParameterRange const& range, std::size_t n_shape,
                       JointScales const& scales) {
  constexpr std::size_t places = 24;
  if (parameter.is_order() || parameter.is_frequency()) {
    double const gap = share_of_resolution * bound_value({1.0, parameter.lower.to}, scales);
    // logarithmic points lie furthest apart at the upper end
    double const gaps = range.spacing == Spacing::logarithmic
                            ? std::log(range.upper / range.lower) / -std::log1p(-gap / range.upper)
                            : (range.upper - range.lower) / gap;
    return static_cast<std::size_t>(std::ceil(gaps)) + 1;
  }
  if (parameter.is_instant() || parameter.lower.to == RelativeTo::position) return places;
  if (n_shape == 1) return 10;
  if (n_shape == 2) return 6;
  if (n_shape > 3 && parameter.none_at_lower) return 1;
  if (range.spacing == Spacing::linear) return n_shape == 3 ? 4 : 1;
  // a refinement comes no further than one point: where the effect changes by decades, more of them
  constexpr double widest_factor = 2.5;
  return std::clamp<std::size_t>(points_apart(range, widest_factor), 3, 10);
}

}  // namespace

double to_unit(ParameterRange const& range, double value) {
  if (!(range.upper > range.lower)) return 0.0;
  if (range.spacing == Spacing::logarithmic) return std::log(value / range.lower) / std::log(range.upper / range.lower);
  if (range.spacing == Spacing::cubic) return std::cbrt((value - range.lower) / (range.upper - range.lower));
  return (value - range.lower) / (range.upper - range.lower);
}

double from_unit(ParameterRange const& range, double unit) {
  if (!(range.upper > range.lower)) return range.lower;
  double const inside = std::clamp(unit, 0.0, 1.0);
  if (range.spacing == Spacing::logarithmic) return range.lower * std::pow(range.upper / range.lower, inside);
  if (range.spacing == Spacing::cubic) return range.lower + std::pow(inside, 3) * (range.upper - range.lower);
  return range.lower + inside * (range.upper - range.lower);
}

std::vector<double> ShapeGrid::point(std::size_t index) const {
  std::vector<double> shape;
  for (std::size_t k = 0; k < axes.size(); ++k) shape.push_back(axes[k][places[index][k]]);
  return shape;
}

std::vector<double> ShapeGrid::to_unit_scale(std::vector<double> const& shape) const {
  std::vector<double> unit;
  for (std::size_t k = 0; k < ranges.size(); ++k) unit.push_back(to_unit(ranges[k], shape[k]));
  return unit;
}

std::vector<double> ShapeGrid::from_unit_scale(std::vector<double> const& unit) const {
  std::vector<double> shape;
  for (std::size_t k = 0; k < ranges.size(); ++k) shape.push_back(from_unit(ranges[k], unit[k]));
  return shape;
}

std::vector<double> ShapeGrid::half_steps() const {
  std::vector<double> steps;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    auto const points = static_cast<double>(axes[k].size());
    steps.push_back(ranges[k].upper > ranges[k].lower ? (points > 1.0 ? 0.5 / (points - 1.0) : 0.5) : 0.0);
  }
  return steps;
}

ShapeGrid grid_over(std::vector<ParameterRange> ranges, std::vector<std::vector<double>> axes, GridPoints points) {
  constexpr std::ptrdiff_t fewest_for_a_lattice = 3;
  ShapeGrid grid{std::move(ranges), std::move(axes), {}};
  bool const is_lattice = points == GridPoints::lattice &&
                          std::count_if(grid.axes.begin(), grid.axes.end(),
                                        [](auto const& axis) { return axis.size() > 1; }) >= fewest_for_a_lattice;
  std::size_t combinations = 1;
  for (auto const& axis : grid.axes) combinations *= axis.size();
  for (std::size_t index = 0; index < combinations; ++index) {
    std::vector<std::size_t> place;
    std::size_t left = index, steps = 0;
    for (auto const& axis : grid.axes) {
      place.push_back(left % axis.size());
      steps += place.back();
      left /= axis.size();
    }
    if (!is_lattice || steps % 2 == 0) grid.places.push_back(std::move(place));
  }
  return grid;
}

namespace {

// of an effect that rings, with this factor from one resonance to the next
ShapeGrid grid_of(Effect const& effect, JointScales const& scales, double resonance_factor, GridPoints which) {
  constexpr std::size_t beside_a_resonance = 4;
  bool const is_ringing = rings(effect);
  std::vector<ParameterRange> ranges = effect.shape_bounds(scales);
  std::vector<std::vector<double>> axes;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    auto const& parameter = effect.parameters()[effect.n_linear() + k];
    auto const& range = ranges[k] = affordable(ranges[k], parameter, scales);
    std::size_t points = 1;
    if (range.upper > range.lower)
      points = parameter.is_resonance ? points_apart(range, resonance_factor)
               : is_ringing           ? beside_a_resonance
                                      : points_for(parameter, range, effect.n_shape(), scales);
    std::vector<double> axis(points);
    for (std::size_t i = 0; i < points; ++i)
      axis[i] = from_unit(range, points > 1 ? static_cast<double>(i) / static_cast<double>(points - 1) : 0.0);
    axes.push_back(std::move(axis));
  }
  return grid_over(std::move(ranges), std::move(axes), which);
}

}  // namespace

ShapeGrid shape_grid(Effect const& effect, JointScales const& scales) {
  constexpr double driven_factor = 1.2;  // a motor that does not ring itself drives the load over a wide band
  return grid_of(effect, scales, driven_factor, GridPoints::lattice);
}

double shape_step(ParameterRange const& range, double value) {
  if (!(range.upper > range.lower)) return 0.0;
  constexpr double share = 1e-3;
  double const step = range.spacing == Spacing::logarithmic ? share * value : share * (range.upper - range.lower);
  return value + step <= range.upper ? step : -step;
}

}  // namespace torquescope
