#include "engine/infer/search/reached_bound.hpp"

#include <cmath>
#include <vector>

#include "engine/base/quantity_text.hpp"
#include "engine/infer/search/shape_grid.hpp"

namespace torquescope {
namespace {

constexpr double bound_rounding = 1e-3;  // of the range: the step of a shape's tangent

// a size in units of the joint may be twice what its scale says (is_far_too_large())
bool is_size_of_joint(EffectParameter const& parameter, Bound const& bound) {
  return !parameter.is_shape && bound.to != RelativeTo::absolute && bound.to != RelativeTo::sample_period;
}

bool is_spared(EffectParameter const& parameter, BoundSide side) {
  Bound const& bound = side == BoundSide::lower ? parameter.lower : parameter.upper;
  if (bound.factor == 0.0 || !std::isfinite(bound.factor) || is_size_of_joint(parameter, bound)) return true;
  return side == BoundSide::lower ? parameter.none_at_lower || parameter.law_at_lower : parameter.law_at_upper;
}

std::optional<BoundSide> side_of(ParameterRange const& range, double value) {
  if (!(range.upper > range.lower)) return std::nullopt;  // fixed by the joint
  if (!std::isfinite(range.lower) || !std::isfinite(range.upper)) {
    if (value == range.lower) return BoundSide::lower;
    if (value == range.upper) return BoundSide::upper;
    return std::nullopt;
  }
  double const unit = to_unit(range, value);
  if (unit <= bound_rounding) return BoundSide::lower;
  if (unit >= 1.0 - bound_rounding) return BoundSide::upper;
  return std::nullopt;
}

}  // namespace

std::optional<ReachedBound> reached_bound(Effect const& effect, std::span<double const> shape,
                                          Eigen::VectorXd const& linear, JointScales const& scales) {
  auto const linear_ranges = effect.linear_bounds(scales), shape_ranges = effect.shape_bounds(scales);
  for (std::size_t k = 0; k < linear_ranges.size(); ++k) {
    double const value = linear[static_cast<Eigen::Index>(k)];
    auto const side = side_of(linear_ranges[k], value);
    if (side && !is_spared(effect.parameters()[k], *side)) return ReachedBound{k, *side, value};
  }
  for (std::size_t k = 0; k < shape.size(); ++k) {
    auto const side = side_of(shape_ranges[k], shape[k]);
    std::size_t const parameter = effect.n_linear() + k;
    if (side && !is_spared(effect.parameters()[parameter], *side)) return ReachedBound{parameter, *side, shape[k]};
  }
  return std::nullopt;
}

std::string bound_words(Effect const& effect, ReachedBound const& bound, JointKind joint) {
  EffectParameter const& parameter = effect.parameters()[bound.parameter];
  std::string name = parameter.name;
  for (char& letter : name)
    if (letter == '_') letter = ' ';
  return "its " + name + " ends at the " + (bound.side == BoundSide::lower ? "least" : "most") + " it can be, " +
         quantity_text(bound.value, parameter.unit_for(joint)) + ": the effect is none of the catalogue";
}

}  // namespace torquescope
