#include "engine/decision/law_trial.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/parallel.hpp"
#include "engine/decision/law_shape.hpp"

namespace torquescope {
namespace {

bool is_beyond_bounds(LawFacts const& law, RefinedLaw const& refined, JointScales const& scales) {
  if (refined.is_at_bound) return true;
  auto const ranges = law.effect->linear_bounds(scales);
  for (Eigen::Index k = 0; k < refined.parameters.size(); ++k)
    if (refined.parameters[k] > ranges[static_cast<std::size_t>(k)].upper) return true;
  return false;
}

Refusal refusal_of(LawFacts const& law, RefinedLaw const& refined, JointScales const& scales,
                   DecisionNumbers const& numbers) {
  if (!(law.size >= numbers.delta)) return Refusal::too_small;
  if (is_beyond_bounds(law, refined, scales)) return Refusal::at_bound;
  if (!(law.judged_after < law.judged_before)) return Refusal::not_predicted;
  return law.judged_after <= (1.0 - numbers.least_fall) * law.judged_before ? Refusal::none : Refusal::too_small;
}

TriedLaw tried(DecisionQuestion const& question, TrialModel const& beside, LawQuestion const& law,
               LawFinding const& found, FoldKind kind) {
  if (!(found.gain > 0.0)) return {0, LawFacts{law.effect}, {}};
  RefinedLaw const refined = refined_law(law, found, *beside.fitted.fitted, beside.score, kind);
  TriedLaw one{0, {law.effect, refined.shape, std::max(found.gain, refined.gain)}, {}};
  one.facts.size = refined.rms / beside.rows.torque_rms();
  auto effects = beside.effects;
  effects.push_back({law.effect, refined.shape});
  one.with = fitted_model(beside.rows, question.regressor, std::move(effects), beside.fitted.fitted.get(),
                          {DelaySearch::everywhere, question.numbers.longest_delay_s});
  one.facts.judged_before = beside.judged;
  one.facts.judged_after = errors_of(beside.rows, one.with).judged();
  one.facts.refusal = refusal_of(one.facts, refined, beside.scales, question.numbers);
  return one;
}

}  // namespace

std::vector<std::size_t> by_gain(std::vector<LawFinding> const& findings) {
  std::vector<std::size_t> order(findings.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return findings[a].gain > findings[b].gain; });
  return order;
}

std::vector<TriedLaw> tried_laws(DecisionQuestion const& question, TrialModel const& beside,
                                 std::vector<LawQuestion> const& laws, std::vector<LawFinding> const& findings,
                                 FoldKind kind) {
  auto const order = by_gain(findings);
  std::vector<TriedLaw> all(std::min(question.numbers.refined, order.size()));
  parallel_for(all.size(), question.threads, [&](std::size_t k, int) {
    all[k] = tried(question, beside, laws[order[k]], findings[order[k]], kind);
    all[k].question = order[k];
  });
  std::stable_sort(all.begin(), all.end(),
                   [](TriedLaw const& a, TriedLaw const& b) { return a.facts.gain > b.facts.gain; });
  return all;
}

}  // namespace torquescope
