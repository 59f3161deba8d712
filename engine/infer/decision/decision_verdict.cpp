#include "engine/infer/decision/decision_verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace torquescope {
namespace {

// beyond chance, and worth a name
bool is_doubted(EffectFacts const& facts) {
  return facts.refusal == Refusal::at_bound || facts.refusal == Refusal::not_predicted;
}

// the least torque that is large enough, and of which the error would fall by least_fall
double least_worth_naming(double error, DecisionNumbers const& numbers) {
  double const left = 1.0 - numbers.least_fall;
  return std::max(numbers.delta, std::sqrt(1.0 - left * left) * error);
}

}  // namespace

bool is_adequate(StepFacts const& step, DecisionNumbers const& numbers) {
  bool const counts = step.correction.size >= least_worth_naming(step.error, numbers);
  if (counts && step.correction.p <= numbers.correction_alpha()) return false;
  // one that is refused is a second question about the model, as smooth functions are
  return std::none_of(step.effects.begin(), step.effects.end(), [&](EffectFacts const& facts) {
    return facts.refusal == Refusal::none || (is_doubted(facts) && facts.p <= numbers.correction_alpha());
  });
}

bool bears_effects_of_clock(StepFacts const& step) {
  return std::none_of(step.effects.begin(), step.effects.end(),
                      [](EffectFacts const& facts) { return facts.refusal == Refusal::none || is_doubted(facts); });
}

bool is_complete(std::span<StepFacts const> steps, DecisionNumbers const& numbers) {
  if (steps.empty()) return false;
  return std::all_of(steps.begin(), steps.end(), [&](StepFacts const& step) {
    return is_adequate(step, numbers) && (step.is_of_clock || !step.could_hide(numbers.tolerance));
  });
}

bool was_adequate(DecisionFacts const& facts, DecisionNumbers const& numbers) {
  for (auto const& step : facts.steps) {
    if (!is_adequate(step, numbers)) return false;
    if (step.has_taken) break;
  }
  return true;
}

double smallest_named(DecisionFacts const& facts, DecisionNumbers const& numbers) {
  for (auto step = facts.steps.rbegin(); step != facts.steps.rend(); ++step)
    if (!step->is_of_clock) return std::max(step->visible, least_worth_naming(step->error, numbers));
  return std::numeric_limits<double>::quiet_NaN();
}

Verdict verdict_from(DecisionOutcome const& of) {
  if (of.neighbours_predict) return Verdict::unexplained;
  if (!of.has_names || !of.is_lower) {
    if (!of.was_adequate) return Verdict::unexplained;
    return of.can_tell_little ? Verdict::insufficient : Verdict::none;
  }
  // what else is missing shows once the channel is mended
  if (of.all_on_channel) return Verdict::data_fault;
  if (!of.is_complete) return Verdict::partly;
  return of.has_class ? Verdict::one_of_class : Verdict::named;
}

}  // namespace torquescope
