#include "engine/diagnose/effect_names.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/diagnose/strip_account.hpp"
#include "engine/fit/statistics/block_jackknife.hpp"

namespace torquescope {
namespace {

ParameterEstimate estimate(std::string name, std::string unit, FittedNumber const& number) {
  double const width = jackknife_quantile * number.deviation;
  return {std::move(name), std::move(unit), number.value, number.value - width, number.value + width};
}

// wave: 1 for the first of its effect, 2 for the second
std::vector<ParameterEstimate> parameters_of(JointDecision const& decision, std::size_t i, std::ptrdiff_t wave) {
  JointModel const& model = *decision.final.model;
  auto const& numbers = decision.facts.parameters;
  EffectFacts const& facts = decision.facts.accepted[i];
  std::size_t shape_at = model.size();
  for (std::size_t before = 0; before < i; ++before) shape_at += model.effects()[before].shape.size();
  std::vector<ParameterEstimate> estimates;
  auto const& parameters = facts.effect->parameters();
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    std::size_t const at = parameters[k].is_shape ? shape_at++ : model.first_parameter(i) + k;
    FittedNumber const known =
        at < numbers.size() ? numbers[at] : FittedNumber{facts.shape[k - facts.effect->n_linear()], unknown};
    std::string const name = parameters[k].name + (wave > 1 ? "_" + std::to_string(wave) : "");
    estimates.push_back(estimate(name, parameters[k].unit_for(model.regressor().joint()), known));
  }
  return estimates;
}

NamedEffect named_by_scan(JointDecision const& decision, MismatchRows const& rows, std::size_t i) {
  EffectFacts const& facts = decision.facts.accepted[i];
  NamedEffect named = named_after(*facts.effect);
  EffectAccount account = account_of(decision, rows, i);
  named.p = named.q = facts.p;
  named.z = std::sqrt(facts.gain);
  named.region = account.region;
  named.places = std::move(account.places);
  named.curve = std::move(account.curve);
  named.rms = account.rms;
  named.peak = account.peak;
  return named;
}

NamedEffect named_delay(Effect const& timing, DecisionFacts const& facts) {
  DelayFacts const& delay = facts.delay;
  NamedEffect named = named_after(timing);
  named.p = named.q = least_p(facts.steps.empty() ? 0 : facts.steps.front().replicates);
  named.z = std::sqrt(delay.gain);
  named.rms = delay.size * facts.torque_rms;
  named.parameters.push_back(estimate(named.name, "s", {delay.late_s, delay.deviation_s}));
  return named;
}

}  // namespace

std::vector<ParameterEstimate> estimates_of(JointModel const& model, std::vector<FittedNumber> const& numbers) {
  std::vector<ParameterEstimate> estimates;
  auto const& owners = model.regressor().column_owners();
  for (std::size_t k = 0; k < owners.size(); ++k)
    estimates.push_back(estimate(owners[k].name, owners[k].unit, numbers[k]));
  return estimates;
}

EffectNames names_of_scan(JointDecision const& decision) {
  DecisionFacts const& facts = decision.facts;
  EffectNames names{{}, estimates_of(*decision.final.model, facts.parameters)};
  MismatchRows const rows = mismatch_rows(decision.final, decision.final_replicates);
  for (std::size_t i = 0; i < facts.accepted.size(); ++i) {
    EffectFacts const& own = facts.accepted[i];
    auto same = std::find_if(names.effects.begin(), names.effects.end(),
                             [&](NamedEffect const& one) { return one.name == own.effect->name(); });
    if (same == names.effects.end()) same = names.effects.insert(names.effects.end(), named_by_scan(decision, rows, i));
    for (auto const* rival : own.rivals)
      if (std::find(same->equivalent.begin(), same->equivalent.end(), rival->name()) == same->equivalent.end())
        same->equivalent.push_back(rival->name());
    auto const end = facts.accepted.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    auto const wave =
        std::count_if(facts.accepted.begin(), end, [&](EffectFacts const& one) { return one.effect == own.effect; });
    for (auto& parameter : parameters_of(decision, i, wave)) {
      same->parameters.push_back(parameter);
      names.parameters.push_back(std::move(parameter));
    }
  }
  auto const timing = std::find_if(effect_choices().begin(), effect_choices().end(),
                                   [](Effect const* one) { return one->is_torque_timing(); });
  if (facts.delay.is_named && timing != effect_choices().end()) {
    names.effects.push_back(named_delay(**timing, facts));
    names.parameters.push_back(names.effects.back().parameters.front());
  }
  return names;
}

}  // namespace torquescope
