#include "engine/infer/decision/effect_trial.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/parallel.hpp"
#include "engine/infer/decision/effect_shape.hpp"

namespace torquescope {
namespace {

bool is_beyond_bounds(EffectFacts const& facts, RefinedEffect const& refined, JointScales const& scales) {
  if (refined.is_at_bound) return true;
  auto const ranges = facts.effect->linear_bounds(scales);
  for (Eigen::Index k = 0; k < refined.parameters.size(); ++k)
    if (refined.parameters[k] > ranges[static_cast<std::size_t>(k)].upper) return true;
  return false;
}

Refusal refusal_of(EffectFacts const& facts, RefinedEffect const& refined, JointScales const& scales,
                   DecisionNumbers const& numbers) {
  bool const falls = facts.judged_after < facts.judged_before;
  bool const falls_enough = facts.judged_after <= (1.0 - numbers.least_fall) * facts.judged_before;
  if (!(facts.size >= numbers.delta) || (falls && !falls_enough)) return Refusal::too_small;
  if (is_beyond_bounds(facts, refined, scales)) return Refusal::at_bound;
  return falls ? Refusal::none : Refusal::not_predicted;
}

TriedEffect tried(DecisionQuestion const& question, TrialModel const& beside, EffectQuestion const& effect,
                  EffectFinding const& found, FoldKind kind) {
  if (!(found.gain > 0.0)) return {0, EffectFacts{effect.effect}, {}};
  RefinedEffect const refined =
      refined_effect(effect, found, *beside.fitted.fitted, beside.score, question.numbers.least_fall);
  TriedEffect one{0, {effect.effect, refined.shape, std::max(found.gain, refined.gain)}, {}};
  one.facts.size = refined.rms / beside.rows.torque_rms();
  auto effects = beside.effects;
  effects.push_back({effect.effect, refined.shape});
  one.with = fitted_model(beside.rows, question.regressor, std::move(effects), beside.fitted.fitted.get(),
                          free_delay(question.numbers));
  bool const is_of_clock = kind == FoldKind::interleaved;
  one.facts.judged_before = is_of_clock ? error_on_folds(beside.rows, beside.fitted) : beside.judged;
  one.facts.judged_after =
      is_of_clock ? error_on_folds(beside.rows, one.with) : errors_of(beside.rows, one.with).judged();
  one.facts.refusal = refusal_of(one.facts, refined, beside.scales, question.numbers);
  return one;
}

}  // namespace

std::vector<std::size_t> places_of_largest(Eigen::VectorXd const& values, Eigen::Index most) {
  std::vector<std::size_t> order(static_cast<std::size_t>(values.size()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return values[static_cast<Eigen::Index>(a)] > values[static_cast<Eigen::Index>(b)];
  });
  order.resize(std::min(order.size(), static_cast<std::size_t>(most)));
  return order;
}

Eigen::VectorXd gains_of(std::vector<EffectFinding> const& findings) {
  Eigen::VectorXd gains(static_cast<Eigen::Index>(findings.size()));
  for (std::size_t i = 0; i < findings.size(); ++i) gains[static_cast<Eigen::Index>(i)] = findings[i].gain;
  return gains;
}

std::vector<TriedEffect> tried_effects(DecisionQuestion const& question, TrialModel const& beside,
                                       std::vector<EffectQuestion> const& effects,
                                       std::vector<EffectFinding> const& findings,
                                       std::vector<std::size_t> const& which, FoldKind kind) {
  std::vector<TriedEffect> all(which.size());
  parallel_for(all.size(), question.threads, [&](std::size_t k, int) {
    all[k] = tried(question, beside, effects[which[k]], findings[which[k]], kind);
    all[k].question = which[k];
  });
  return all;
}

}  // namespace torquescope
