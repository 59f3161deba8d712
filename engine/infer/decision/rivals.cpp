#include "engine/infer/decision/rivals.hpp"

#include <algorithm>
#include <utility>

#include "engine/infer/decision/effect_trial.hpp"

namespace torquescope {
namespace {

using Tried = std::vector<TriedEffect>;

// an error on judged rows, by what is worth a name
bool is_higher(DecisionContext const& on, double judged, double than) {
  return (1.0 - on.question.numbers.least_fall) * judged > than;
}

// D that chance gives a rival beside the model that the effect was taken beside; later models give it their own
double level_beside(std::span<StepFacts const> steps, Effect const* effect, Effect const* rival) {
  auto const of = [](StepFacts const& step, Effect const* asked) {
    return std::find_if(step.effects.begin(), step.effects.end(),
                        [&](EffectFacts const& one) { return one.effect == asked; });
  };
  for (auto const& step : steps) {
    auto const taken = of(step, effect), asked = of(step, rival);
    if (taken != step.effects.end() && taken->refusal == Refusal::none && asked != step.effects.end())
      return asked->level;
  }
  return level_of(steps, rival);
}

// all that may be asked in the place of one effect
std::vector<EffectQuestion> questions_in_place_of(DecisionContext const& on, AcceptedModel const& model,
                                                  Effect const* effect, FoldKind kind) {
  std::vector<Effect const*> asked = effects_to_ask(on, model, false);
  if (kind == FoldKind::interleaved) {
    auto const of_clock = effects_to_ask(on, model, true);
    asked.insert(asked.end(), of_clock.begin(), of_clock.end());
  }
  std::erase(asked, effect);
  return questions_of(on, asked);
}

// other recordings may speak against it
Tried::iterator weight_in_place_of(DecisionContext const& on, AcceptedModel const& model, Effect const& effect,
                                   Tried& tried) {
  if (effect.family() != EffectFamily::static_position || effect.is_weight()) return tried.end();
  return std::find_if(tried.begin(), tried.end(), [&](TriedEffect const& one) {
    bool const is_refuted = !on.rows.validation.empty() && is_higher(on, one.facts.judged_after, model.judged);
    return one.facts.effect->is_weight() && !is_refuted;
  });
}

AcceptedModel with_instead(DecisionContext const& on, AcceptedModel model, std::size_t place, TriedEffect by,
                           std::span<StepFacts const> steps) {
  EffectFacts& taken = model.effects[place];
  std::replace(taken.rivals.begin(), taken.rivals.end(), by.facts.effect, taken.effect);
  by.facts.rivals = std::move(taken.rivals);
  by.facts.p = taken.p;
  by.facts.level = level_of(steps, by.facts.effect);
  // the model has its effects in the order of the names
  auto const at = model.effects.begin() + static_cast<std::ptrdiff_t>(place);
  std::rotate(at, at + 1, model.effects.end());
  model.effects.back() = std::move(by.facts);
  model.fit = std::move(by.with);
  model.judged = errors_of(on.rows, model.fit).judged();
  return model;
}

}  // namespace

AcceptedModel with_rivals(DecisionContext const& on, AcceptedModel model, std::size_t place,
                          std::span<StepFacts const> steps) {
  Effect const* const effect = model.effects[place].effect;
  FoldKind const kind = folds_of(*effect);
  auto const others = shaped_without(model, place);
  FittedModel const without = fitted_with(on, others, *model.fit.fitted);
  FittedStrips const& fitted = *without.fitted;
  Score const score(fitted.base(), fitted.residual(), fitted.guard(), kind);
  auto const questions = questions_in_place_of(on, model, effect, kind);
  auto const findings = scan_recording(questions, fitted, score, on.question.threads);
  TrialModel const beside{on.rows, without, others, score, on.scales, errors_of(on.rows, without).judged()};
  Tried tried = tried_effects(on.question, beside, questions, findings,
                              places_of_largest(gains_of(findings), on.question.numbers.refined), kind);
  double const gain = gain_beside(without, model.effects[place]);
  double const as_it_is = kind == FoldKind::interleaved ? error_on_folds(on.rows, model.fit) : model.judged;
  std::erase_if(tried, [&](TriedEffect const& one) {
    double const own = level_beside(steps, effect, one.facts.effect);
    double const least = gain - std::max(level_beside(steps, effect, effect), own);
    bool const is_as_good = one.facts.gain >= least || !is_higher(on, one.facts.judged_after, as_it_is);
    return one.facts.refusal != Refusal::none || one.facts.gain < own || !is_as_good;
  });
  model.effects[place].gain = gain;
  for (auto const& one : tried) model.effects[place].rivals.push_back(one.facts.effect);
  if (auto const weight = weight_in_place_of(on, model, *effect, tried); weight != tried.end())
    return with_instead(on, std::move(model), place, std::move(*weight), steps);
  auto const best = std::min_element(tried.begin(), tried.end(), [](TriedEffect const& a, TriedEffect const& b) {
    return a.facts.judged_after < b.facts.judged_after;
  });
  bool const is_told = !on.rows.validation.empty() && best != tried.end() && best->facts.judged_after < as_it_is;
  return is_told ? with_instead(on, std::move(model), place, std::move(*best), steps) : std::move(model);
}

}  // namespace torquescope
