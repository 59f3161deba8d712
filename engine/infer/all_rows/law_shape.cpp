#include "engine/infer/all_rows/law_shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/fit/optim/pattern_search.hpp"

namespace torquescope {

RefinedLaw refined_law(LawQuestion const& question, LawFinding const& from, FittedStrips const& fitted,
                       Score const& score, FoldKind kind) {
  constexpr double no_change = 1e-6;
  constexpr int most_evaluations = 80;
  Effect const& effect = *question.effect;
  auto const& ranges = question.grid.ranges;
  auto const left_at = [&](std::vector<double> const& unit) {
    auto const group = law_group(fitted, score.basis(), effect, question.grid.from_unit_scale(unit));
    return score.left_with(group, kind)[0];
  };
  auto const [unit, best] = pattern_search({question.grid.to_unit_scale(question.grid.point(from.point)), from.left},
                                           question.grid.half_steps(), most_evaluations, left_at);
  RefinedLaw refined;
  refined.shape = question.grid.from_unit_scale(unit);
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
