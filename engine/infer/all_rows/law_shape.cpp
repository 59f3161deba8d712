#include "engine/infer/all_rows/law_shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace torquescope {

RefinedLaw refined_law(LawQuestion const& question, LawFinding const& from, FittedStrips const& fitted,
                       Score const& score, FoldKind kind) {
  constexpr double finest = 1e-3, no_change = 1e-6;
  constexpr int most_evaluations = 80;
  Effect const& effect = *question.effect;
  auto const& ranges = question.grid.ranges;
  std::vector<double> unit, step;
  std::vector<double> const start = question.grid.point(from.point);
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    unit.push_back(to_unit(ranges[k], start[k]));
    auto const points = static_cast<double>(question.grid.axes[k].size());
    step.push_back(ranges[k].upper > ranges[k].lower ? (points > 1.0 ? 0.5 / (points - 1.0) : 0.5) : 0.0);
  }
  auto const shape_at = [&](std::vector<double> const& at) {
    std::vector<double> shape;
    for (std::size_t k = 0; k < ranges.size(); ++k) shape.push_back(from_unit(ranges[k], at[k]));
    return shape;
  };
  int evaluations = 0;
  auto const left_at = [&](std::vector<double> const& at) {
    ++evaluations;
    return score.left_with(law_group(fitted, score.basis(), effect, shape_at(at)), kind)[0];
  };
  double best = from.left;
  auto const widest = [&] { return step.empty() ? 0.0 : *std::max_element(step.begin(), step.end()); };
  double const smallest = finest * widest();
  while (widest() > smallest && evaluations < most_evaluations) {
    bool moved = false;
    for (std::size_t k = 0; k < unit.size(); ++k)
      for (double const side : {1.0, -1.0}) {
        auto tried = unit;
        tried[k] = std::clamp(unit[k] + side * step[k], 0.0, 1.0);
        if (step[k] == 0.0 || tried[k] == unit[k]) continue;
        double const left = left_at(tried);
        if (!(left < best)) continue;
        best = left;
        unit = std::move(tried);
        moved = true;
        break;
      }
    if (!moved)
      for (double& one : step) one *= 0.4;
  }
  RefinedLaw refined;
  refined.shape = shape_at(unit);
  OrthonormalGroup const group = law_group(fitted, score.basis(), effect, refined.shape);
  BoundedGain const explained = bounded_gain(group, group.q.transpose() * score.signals().col(0));
  refined.gain = score.gain(group, 0, kind);
  refined.rms = std::sqrt(explained.gain / static_cast<double>(score.signals().rows()));
  refined.parameters = explained.parameters;
  for (std::size_t k = 0; k < unit.size(); ++k) {
    EffectParameter const& parameter = effect.parameters()[effect.n_linear() + k];
    bool const has_range = ranges[k].upper > ranges[k].lower;
    // 0 where it cannot be negative is a limit of physics (search/reached_bound.hpp)
    bool const is_zero = parameter.lower.factor == 0.0;
    bool const is_low = unit[k] <= 0.0 && !is_zero && !parameter.law_at_lower && !parameter.none_at_lower;
    bool const is_high = unit[k] >= 1.0 && !parameter.law_at_upper;
    if (!has_range || (!is_low && !is_high)) continue;
    // one that changes nothing, as the rest of a spring that does not harden, is at no bound
    auto inside = unit;
    inside[k] = 0.5;
    refined.is_at_bound = refined.is_at_bound || left_at(inside) > best * (1.0 + no_change);
  }
  return refined;
}

}  // namespace torquescope
