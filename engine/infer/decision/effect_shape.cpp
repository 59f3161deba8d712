#include "engine/infer/decision/effect_shape.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/fit/optim/pattern_search.hpp"

namespace torquescope {
namespace {

using UnitShape = std::vector<double>;

// a shape that ends where the effect does not, and where no other limit of physics is
bool ends_at_bound(EffectParameter const& parameter, ParameterRange const& range, double unit) {
  if (!(range.upper > range.lower)) return false;
  bool const is_zero = parameter.lower.factor == 0.0;
  bool const is_low = unit <= 0.0 && !is_zero && !parameter.effect_at_lower && !parameter.none_at_lower;
  return is_low || (unit >= 1.0 && !parameter.effect_at_upper);
}

class ShapeSearch {
 public:
  ShapeSearch(EffectQuestion const& question, FittedStrips const& fitted, Score const& score)
      : question_(question), fitted_(fitted), score_(score) {}

  OrthonormalGroup group(UnitShape const& at) const {
    return effect_group(fitted_, score_.basis(), *question_.effect, question_.grid.from_unit_scale(at));
  }
  double left(UnitShape const& at) const {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    bool const is_itself = question_.effect->is_plausible(question_.grid.from_unit_scale(at), question_.scales);
    return is_itself ? score_.left_with(group(at))[0] : infinite;
  }
  // what held-out rows lose by the effect, in their logarithm: D, but for n_eff, which differs from shape to shape
  double fall(double left) const { return std::log(score_.left()[0] / left); }

  // held: a shape that stays
  LowestPoint best_from(LowestPoint start, std::optional<std::size_t> held = {}) const {
    constexpr int most_evaluations = 80;
    auto steps = question_.grid.half_steps();
    if (held) steps[*held] = 0.0;
    return pattern_search(std::move(start), std::move(steps), most_evaluations,
                          [&](UnitShape const& unit) { return left(unit); });
  }

 private:
  EffectQuestion const& question_;
  FittedStrips const& fitted_;
  Score const& score_;
};

}  // namespace

RefinedEffect refined_effect(EffectQuestion const& question, EffectFinding const& from, FittedStrips const& fitted,
                             Score const& score, double least_fall) {
  Effect const& effect = *question.effect;
  ShapeSearch const search(question, fitted, score);
  auto const [unit, left] = search.best_from({question.grid.to_unit_scale(question.grid.point(from.point)), from.left});
  RefinedEffect refined;
  refined.shape = question.grid.from_unit_scale(unit);
  OrthonormalGroup const group = search.group(unit);
  BoundedGain const explained = bounded_gain(group, group.q.transpose() * score.signals().col(0));
  refined.gain = score.gain(group, 0);
  refined.rms = std::sqrt(explained.gain / static_cast<double>(score.signals().rows()));
  refined.parameters = explained.parameters;
  for (std::size_t k = 0; k < unit.size() && !refined.is_at_bound; ++k) {
    if (!ends_at_bound(effect.parameters()[effect.n_linear() + k], question.grid.ranges[k], unit[k])) continue;
    // one that hardly changes anything, as the rest of a spring that does not harden, is at no bound
    constexpr double middle = 0.5;
    UnitShape inside = unit;
    inside[k] = middle;
    double const first = search.left(inside), held = search.best_from({std::move(inside), first}, k).cost;
    refined.is_at_bound = search.fall(held) < (1.0 - least_fall) * search.fall(left);
  }
  return refined;
}

}  // namespace torquescope
