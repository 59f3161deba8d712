#include "engine/infer/decision/loop_moves.hpp"

#include <algorithm>
#include <cmath>

#include "engine/effects/carry_over.hpp"

namespace torquescope {
bool can_be_simulated(Effect const& effect, Regressor const& regressor) {
  auto const& terms = regressor.terms();
  return !effect.is_given() && !effect.is_of_whole_arm() && !effect.is_torque_timing() &&
         std::find(terms.begin(), terms.end(), &effect) == terms.end();
}

LoopMove effect_move(Effect const& effect, std::vector<double> const& shape, JointScales const& scales) {
  LoopMove move{{&effect}, {}};
  auto const ranges = effect.shape_bounds(scales);
  std::vector<double> begin;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    ParameterRange const& range = ranges[k];
    bool const is_logarithmic = range.spacing == Spacing::logarithmic && range.lower > 0.0;
    double const middle = is_logarithmic ? std::sqrt(range.lower * range.upper) : 0.5 * (range.lower + range.upper);
    bool const can_be_none = effect.parameters()[effect.n_linear() + k].none_at_lower;
    begin.push_back(k < shape.size() ? shape[k] : can_be_none ? range.lower : middle);
  }
  move.starts.push_back(begin);
  if (begin.empty() || effect.is_wave()) return move;
  bool const is_logarithmic = ranges[0].spacing == Spacing::logarithmic && ranges[0].lower > 0.0;
  for (double const share : {0.2, 0.4, 0.6, 0.8}) {
    begin[0] = is_logarithmic ? ranges[0].lower * std::pow(ranges[0].upper / ranges[0].lower, share)
                              : ranges[0].lower + share * (ranges[0].upper - ranges[0].lower);
    move.starts.push_back(begin);
  }
  return move;
}

std::vector<LoopMove> effect_moves(DecisionFacts const& scan, Regressor const& regressor, JointScales const& scales,
                                   DecisionNumbers const& numbers) {
  std::vector<LoopMove> moves;
  auto const has = [&](Effect const* effect) {
    return std::any_of(moves.begin(), moves.end(), [&](LoopMove const& one) { return one.subject.effect == effect; });
  };
  for (auto const& effect : scan.accepted)
    if (can_be_simulated(*effect.effect, regressor) && (effect.effect->is_wave() || !has(effect.effect)))
      moves.push_back(effect_move(*effect.effect, effect.shape, scales));
  std::vector<double> const no_shape;
  std::size_t const most = moves.size() + static_cast<std::size_t>(numbers.refined);
  auto const add = [&](Effect const* effect, std::vector<double> const& shape) {
    if (moves.size() < most && !is_clock_bound(*effect) && can_be_simulated(*effect, regressor) && !has(effect))
      moves.push_back(effect_move(*effect, shape, scales));
  };
  for (auto const& effect : scan.accepted)
    for (auto const* rival : effect.rivals) add(rival, no_shape);
  for (auto const& step : scan.steps)
    for (auto const& effect : step.effects)
      if (effect.p <= numbers.alpha) add(effect.effect, effect.shape);
  return moves;
}

std::vector<DriveEffect const*> drive_effects_of(DriveEffectKind kind) {
  std::vector<DriveEffect const*> effects;
  for (DriveEffect const* effect : drive_effects())
    if (effect->kind == kind) effects.push_back(effect);
  return effects;
}

std::vector<LoopMove> drive_moves(LoopSetting const& loop, std::vector<RolloutTrack> const& training,
                                  std::vector<DriveEffect const*> const& effects, bool fits_weight) {
  std::vector<LoopMove> moves;
  if (loop.form == LoopForm::identified || loop.form == LoopForm::none) return moves;
  DriveScales const scales = drive_scales(training, numbers_of(loop.form, loop.values), fits_weight);
  for (DriveEffect const* effect : effects) {
    LoopKey const own = effect->keys.front();
    bool const is_free = std::find(loop.free.begin(), loop.free.end(), own) != loop.free.end();
    if (is_free || loop.values[own] != facts_of(own).none) continue;
    LoopMove move{{nullptr, own}, {}, effect->least_samples * scales.sample_s};
    for (auto const& start : effect->starts(scales))
      if (effect->adds || (start.front() > facts_of(own).least && start.front() < facts_of(own).most))
        move.starts.push_back(start);
    if (!move.starts.empty()) moves.push_back(std::move(move));
  }
  return moves;
}

}  // namespace torquescope
