#include "engine/diagnose/decision_account.hpp"

#include <utility>

#include "engine/decision/decision_words.hpp"

namespace torquescope {
namespace {

DecisionAccount::Law law_account(LawFacts const& law) {
  DecisionAccount::Law account{law.effect->name(), word(law.refusal), law.shape,       law.gain, law.level, law.p,
                               law.size,           law.judged_before, law.judged_after};
  for (auto const* rival : law.rivals) account.rivals.push_back(rival->name());
  return account;
}

DecisionAccount::Step step_account(StepFacts const& step) {
  CorrectionFacts const& correction = step.correction;
  DecisionAccount::Step account{step.is_of_clock,      step.replicates, word(step.source), step.visible,
                                word(correction.axis), correction.gain, correction.p,      correction.size};
  for (auto const& law : step.laws) account.laws.push_back(law_account(law));
  return account;
}

DecisionAccount::Errors errors_account(ModelErrors const& errors) {
  return {errors.train, errors.held_out, errors.validation};
}

}  // namespace

DecisionAccount account_of(DecisionFacts const& facts, std::string verdict) {
  DecisionAccount account;
  account.verdict = std::move(verdict);
  account.quiet_share = facts.quiet_share;
  account.set_aside_share = facts.set_aside_share;
  account.baseline = errors_account(facts.baseline);
  account.final = errors_account(facts.final);
  for (auto const& step : facts.steps) account.steps.push_back(step_account(step));
  for (auto const& law : facts.accepted) account.accepted.push_back(law_account(law));
  DelayFacts const& delay = facts.delay;
  account.delay = {delay.late_s, delay.deviation_s, delay.gain, delay.p, delay.size, delay.is_named};
  return account;
}

}  // namespace torquescope
