#include "engine/diagnose/decision_account.hpp"

#include <utility>

#include "engine/infer/decision/decision_verdict.hpp"
#include "engine/infer/decision/decision_words.hpp"

namespace torquescope {
namespace {

DecisionAccount::Effect effect_account(EffectFacts const& facts) {
  DecisionAccount::Effect account{facts.effect->name(), word(facts.refusal), facts.shape,
                                  facts.gain,           facts.level,         facts.p,
                                  facts.size,           facts.judged_before, facts.judged_after};
  for (auto const* rival : facts.rivals) account.rivals.push_back(rival->name());
  return account;
}

DecisionAccount::Step step_account(StepFacts const& step) {
  CorrectionFacts const& correction = step.correction;
  DecisionAccount::Step account{step.is_of_clock,      step.replicates, word(step.source), step.visible,
                                word(correction.axis), correction.gain, correction.p,      correction.size};
  for (auto const& effect : step.effects) account.effects.push_back(effect_account(effect));
  return account;
}

DecisionAccount::Errors errors_account(ModelErrors const& errors) {
  return {errors.train, errors.held_out, errors.validation};
}

DecisionAccount::Number number_account(LoopNumber const& number) {
  return {number.name, number.unit, number.value, number.lower, number.upper};
}

DecisionAccount::Rung rung_account(LoopStepFacts const& step) {
  DecisionAccount::Rung rung;
  for (auto const& subject : step.model) rung.model.push_back(name_of(subject));
  rung.replicates = step.replicates;
  for (auto const& move : step.moves)
    rung.moves.push_back({name_of(move.subject), word(move.refusal), move.gain, move.level, move.p, move.before.both(),
                          move.after.both()});
  return rung;
}

DecisionAccount::Move kept_account(KeptMove const& move) {
  DecisionAccount::Move account{name_of(move.subject), word(MoveRefusal::none), move.gain, 0.0, move.p};
  for (auto const& number : move.numbers) account.numbers.push_back(number_account(number));
  for (auto const& rival : move.rivals) account.rivals.push_back(name_of(rival));
  return account;
}

DecisionAccount::Simulated simulated_account(LoopErrors const& errors) { return {errors.position, errors.torque}; }

}  // namespace

DecisionAccount::Loop account_of(LoopFacts const& facts) {
  DecisionAccount::Loop account;
  account.reason = word(facts.reason);
  account.controller = word(facts.form);
  account.counts_torque = facts.counts[1];
  account.decides = facts.decides();
  account.loop_error = facts.loop_error;
  account.fitted_share = facts.fitted_share;
  account.base_train = simulated_account(facts.base_train);
  account.base_validation = simulated_account(facts.base_validation);
  account.final_train = simulated_account(facts.final_train);
  account.final_validation = simulated_account(facts.final_validation);
  for (auto const& step : facts.steps) account.steps.push_back(rung_account(step));
  for (auto const& move : facts.kept) account.kept.push_back(kept_account(move));
  for (auto const& number : facts.numbers) account.numbers.push_back(number_account(number));
  return account;
}

DecisionAccount account_of(DecisionFacts const& facts, DecisionNumbers const& numbers, std::string verdict) {
  DecisionAccount account;
  account.verdict = std::move(verdict);
  account.quiet_share = facts.quiet_share;
  account.set_aside_share = facts.set_aside_share;
  account.smallest_named = smallest_named(facts, numbers);
  account.sticking_length = facts.sticking_length;
  account.baseline = errors_account(facts.baseline);
  account.final = errors_account(facts.final);
  for (auto const& step : facts.steps) account.steps.push_back(step_account(step));
  for (auto const& effect : facts.accepted) account.accepted.push_back(effect_account(effect));
  DelayFacts const& delay = facts.delay;
  account.delay = {delay.late_s, delay.deviation_s, delay.gain, delay.p, delay.size, delay.is_named};
  return account;
}

}  // namespace torquescope
