#include "engine/infer/decision/accepted_model.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/effects/carry_over.hpp"
#include "engine/infer/decision/shape_fit.hpp"
#include "engine/infer/decision/sticking_shape.hpp"

namespace torquescope {
namespace {

AcceptedModel dropped(DecisionContext const& on, AcceptedModel model, std::size_t place, FittedModel without) {
  model.effects.erase(model.effects.begin() + static_cast<std::ptrdiff_t>(place));
  model.fit = std::move(without);
  model.judged = errors_of(on.rows, model.fit).judged();
  return model;
}

}  // namespace

FittedModel fitted_with(DecisionContext const& on, std::vector<ShapedEffect> effects, FittedStrips const& sizes) {
  return fitted_model(on.rows, on.question.regressor, std::move(effects), &sizes, free_delay(on.question.numbers));
}

std::vector<ShapedEffect> shaped_effects(AcceptedModel const& model) {
  std::vector<ShapedEffect> effects;
  for (auto const& one : model.effects) effects.push_back({one.effect, one.shape});
  return effects;
}

std::vector<ShapedEffect> shaped_without(AcceptedModel const& model, std::size_t place) {
  auto effects = shaped_effects(model);
  effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(place));
  return effects;
}

FittedModel fitted_without(DecisionContext const& on, AcceptedModel const& model, std::size_t place) {
  return fitted_with(on, shaped_without(model, place), *model.fit.fitted);
}

std::vector<Effect const*> effects_to_ask(DecisionContext const& on, AcceptedModel const& model, bool of_clock) {
  std::vector<Effect const*> effects;
  for (auto const* effect : on.question.effects) {
    bool const is_taken =
        std::any_of(model.effects.begin(), model.effects.end(), [&](auto const& one) { return one.effect == effect; });
    if (is_clock_bound(*effect) != of_clock || (is_taken && !effect->may_come_again()) || effect->is_torque_timing())
      continue;
    effects.push_back(effect);
  }
  return effects;
}

std::vector<EffectQuestion> questions_of(DecisionContext const& on, std::vector<Effect const*> const& effects) {
  return effect_questions(effects, on.scales, sticking_bounds(on.rows.training->front().resolution).most_length);
}

FoldKind folds_of(Effect const& effect) { return is_clock_bound(effect) ? FoldKind::interleaved : FoldKind::whole; }

double gain_beside(FittedModel const& without, EffectFacts const& effect) {
  FittedStrips const& fitted = *without.fitted;
  Score const score(fitted.base(), fitted.residual(), fitted.guard(), folds_of(*effect.effect));
  return score.gain(effect_group(fitted, score.basis(), *effect.effect, effect.shape), 0);
}

double level_of(std::span<StepFacts const> steps, Effect const* effect) {
  for (std::size_t i = steps.size(); i-- > 0;)
    for (auto const& asked : steps[i].effects)
      if (asked.effect == effect) return asked.level;
  return 0.0;
}

AcceptedModel with_effect(DecisionContext const& on, AcceptedModel model, EffectFacts effect,
                          FittedStrips const& sizes) {
  model.effects.push_back(std::move(effect));
  auto const with = [&](std::vector<ShapedEffect> effects) { return fitted_with(on, std::move(effects), sizes); };
  model.fit = with_fitted_shapes(with(shaped_effects(model)), with);
  for (std::size_t i = 0; i < model.effects.size(); ++i) model.effects[i].shape = model.fit.model->effects()[i].shape;
  model.judged = errors_of(on.rows, model.fit).judged();
  return model;
}

AcceptedModel without_useless(DecisionContext const& on, AcceptedModel model, std::span<StepFacts const> steps) {
  while (!model.effects.empty()) {
    std::size_t weakest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < model.effects.size(); ++i) {
      double const beyond_chance =
          gain_beside(fitted_without(on, model, i), model.effects[i]) - level_of(steps, model.effects[i].effect);
      if (beyond_chance < least) {
        least = beyond_chance;
        weakest = i;
      }
    }
    if (least > 0.0) return model;
    FittedModel without = fitted_without(on, model, weakest);
    if (errors_of(on.rows, without).judged() > model.judged) return model;  // another recording needs it
    model = dropped(on, std::move(model), weakest, std::move(without));
  }
  return model;
}

AcceptedModel without_effects_of_clock(DecisionContext const& on, AcceptedModel model) {
  for (std::size_t place = model.effects.size(); place-- > 0;) {
    if (!is_clock_bound(*model.effects[place].effect)) continue;
    FittedModel without = fitted_without(on, model, place);
    model = dropped(on, std::move(model), place, std::move(without));
  }
  return model;
}

}  // namespace torquescope
