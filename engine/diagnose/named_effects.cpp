#include "engine/diagnose/named_effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/diagnose/effect_account.hpp"
#include "engine/infer/search/blocked_mismatch.hpp"
#include "engine/infer/search/parameter_intervals.hpp"

namespace torquescope {
namespace {

// blocked: energy that the baseline leaves on blocks it was not fitted to
NamedEffect described(Selection const& selection, std::size_t i, double blocked) {
  auto const& accepted = selection.accepted[i];
  auto const& effect = *accepted.effect;
  double const residual = selection.first_energy.residual;
  EffectAccount account = account_of(*selection.final, i);
  NamedEffect named = named_after(effect);
  named.p = accepted.scan.p;
  named.q = accepted.q;
  named.z = accepted.scan.z;
  named.p_is_bound = accepted.scan.p_is_bound;
  named.gain.train = accepted.gain / residual;
  named.gain.cv = accepted.cv_gain / blocked;
  named.region = account.region;
  named.places = std::move(account.places);
  named.curve = std::move(account.curve);
  named.rms = account.rms;
  named.peak = account.peak;
  return named;
}

// each name once
void add_equivalent(std::vector<RivalLaw> const& rivals, std::vector<std::string>& names) {
  for (auto const& rival : rivals)
    if (std::find(names.begin(), names.end(), rival.effect->name()) == names.end())
      names.push_back(rival.effect->name());
}

// a wave of the same effect once more: its parameters are told from those of the first by a number
std::vector<ParameterEstimate> numbered(std::vector<ParameterEstimate> parameters, std::size_t number) {
  if (number > 1)
    for (auto& parameter : parameters) parameter.name += fmt::format("_{}", number);
  return parameters;
}

}  // namespace

NamedEffects name_effects(Selection const& selection, Evidence const& evidence,
                          std::span<Effect const* const> catalogue, DecisionLevels const& levels,
                          RefinementSetting const& setting) {
  ModelEstimate const estimate = estimate_parameters(*selection.final);
  double const residual = selection.first_energy.residual, blocked = blocked_mismatch(*selection.baseline).energy;
  NamedEffects result;
  result.parameters = estimate.baseline;
  for (std::size_t i = 0; i < selection.accepted.size(); ++i) {
    auto const& accepted = selection.accepted[i];
    auto const same = std::find_if(result.effects.begin(), result.effects.end(),
                                   [&](NamedEffect const& one) { return one.name == accepted.effect->name(); });
    result.place.push_back(static_cast<std::size_t>(same - result.effects.begin()));
    if (same != result.effects.end()) {
      same->gain.train += accepted.gain / residual;
      same->gain.cv += accepted.cv_gain / blocked;
      add_equivalent(confidence_set(evidence, i, catalogue, levels, setting), same->equivalent);
      continue;
    }
    NamedEffect named = described(selection, i, blocked);
    add_equivalent(confidence_set(evidence, i, catalogue, levels, setting), named.equivalent);
    result.effects.push_back(std::move(named));
  }
  std::vector<std::size_t> waves(result.effects.size(), 0);
  for (std::size_t const i : waves_in_order(selection.final->model())) {
    std::size_t const place = result.place[i];
    auto const parameters = numbered(estimate.effects[i], ++waves[place]);
    result.parameters.insert(result.parameters.end(), parameters.begin(), parameters.end());
    auto& own = result.effects[place].parameters;
    own.insert(own.end(), parameters.begin(), parameters.end());
  }
  return result;
}

}  // namespace torquescope
