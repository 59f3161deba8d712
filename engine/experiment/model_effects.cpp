#include "engine/experiment/model_effects.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/effects/given_effect.hpp"
#include "engine/effects/instant_code.hpp"

namespace torquescope {
namespace {

using Parameters = std::vector<ParameterEstimate>;

// "cogging_cos_2": "cogging_cos" and "_2"
struct NumberedName {
  std::string name, number;
};

NumberedName split(std::string const& name) {
  auto const digits = name.find_last_not_of("0123456789");
  if (digits == std::string::npos || digits + 1 == name.size() || name[digits] != '_') return {name, ""};
  return {name.substr(0, digits), name.substr(digits)};
}

Effect const* owner_of(std::string const& parameter) {
  auto const has = [&](Effect const* effect) {
    auto const& own = effect->parameters();
    return std::any_of(own.begin(), own.end(), [&](auto const& one) { return one.name == parameter; });
  };
  for (auto const* choices : {&effect_choices(), &arm_effect_choices()})
    if (auto const found = std::find_if(choices->begin(), choices->end(), has); found != choices->end()) return *found;
  return nullptr;
}

ParameterEstimate const* find(Parameters const& parameters, std::string const& name) {
  auto const found = std::find_if(parameters.begin(), parameters.end(), [&](auto const& p) { return p.name == name; });
  return found == parameters.end() ? nullptr : &*found;
}

// a shape whose bounds leave it one value; a linear parameter that the joint does not have is none of it
std::optional<double> held_value(EffectParameter const& parameter) {
  if (!parameter.is_shape) return 0.0;
  if (parameter.upper.to != RelativeTo::absolute || !std::isfinite(parameter.upper.factor)) return std::nullopt;
  return parameter.upper.factor;
}

// why the levels that the code asks for are not there
std::string lacking(std::string const& code, EffectLevels const& levels) {
  bool const lacks_sign = has_word(code, "friction_sign") && !(std::isfinite(levels.forward + levels.backward));
  bool const lacks_inertia = has_word(code, "baseline_inertia") && !std::isfinite(levels.inertia);
  return lacks_sign || lacks_inertia ? "needs levels that results of earlier versions do not hold" : "";
}

void write_code(EstimatedEffect& estimated, std::string const& number, EffectLevels const& levels) {
  Effect const& effect = *estimated.effect;
  estimated.why_no_code = why_no_code(effect);
  if (!estimated.why_no_code.empty()) return;
  bool const is_plain = effect.has_plain_form() && estimated.parameters.size() == effect.n_linear();
  std::map<std::string, std::string> words;
  for (auto const& parameter : effect.parameters()) {
    std::string const name = parameter.name + number;
    words[parameter.name] = name;
    if (find(estimated.parameters, name) || (is_plain && parameter.is_shape)) continue;
    auto const value = held_value(parameter);
    if (!value) {
      estimated.why_no_code = "has no " + parameter.name + " in the result";
      return;
    }
    estimated.held.push_back({name, parameter.unit_revolute, *value});
  }
  std::string const code = is_plain ? effect.plain_code() : effect.code();
  estimated.why_no_code = lacking(code, levels);
  if (estimated.why_no_code.empty()) estimated.code = with_words(code, words);
}

}  // namespace

std::vector<ParameterEstimate> const& model_of(JointDiagnosis const& joint) {
  return joint.augmented.empty() ? joint.baseline : joint.augmented;
}

std::vector<EstimatedEffect> estimated_effects(JointDiagnosis const& joint) {
  return estimated_effects(model_of(joint), joint.effect_levels);
}

std::vector<EstimatedEffect> estimated_effects(Parameters const& parameters, EffectLevels const& levels) {
  std::vector<EstimatedEffect> effects;
  std::vector<std::string> numbers;  // of each effect
  for (auto const& parameter : parameters) {
    NumberedName own{parameter.name, ""};
    Effect const* effect = owner_of(own.name);
    if (!effect) {
      own = split(parameter.name);
      effect = owner_of(own.name);
    }
    std::size_t at = 0;
    while (at < effects.size() && !(effect && effects[at].effect == effect && numbers[at] == own.number)) ++at;
    if (at == effects.size()) {
      effects.push_back({effect});
      numbers.push_back(own.number);
    }
    effects[at].parameters.push_back(parameter);
  }
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (effects[i].effect) write_code(effects[i], numbers[i], levels);
    if (!effects[i].effect) effects[i].why_no_code = "is no parameter that this version knows";
  }
  return effects;
}

}  // namespace torquescope
