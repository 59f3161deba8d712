#include "engine/diagnose/loop_names.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/effects/carry_over.hpp"
#include "engine/simulate/rollout/drive_effect.hpp"

namespace torquescope {
namespace {

NamedEffect named_command(LoopSubject const& subject) {
  NamedEffect named;
  named.name = subject.key == LoopKey::command_delay_s ? "delay" : name_of(subject);
  named.family = "command";
  named.title = drive_effect_of(subject.key).title;
  named.equation = drive_effect_of(subject.key).equation;
  named.acts_on = word(ActsOn::joint);
  return named;
}

// class and numbers as simulations found them; waves of one effect are one name
NamedEffect as_simulated(NamedEffect named, LoopSubject const& subject, LoopFacts const& loop) {
  named.parameters.clear();
  named.equivalent.clear();
  std::size_t waves = 0;
  for (auto const& move : loop.kept) {
    if (!(move.subject == subject)) continue;
    std::string const number = ++waves > 1 ? "_" + std::to_string(waves) : "";
    for (auto const& rival : move.rivals)
      if (std::find(named.equivalent.begin(), named.equivalent.end(), name_of(rival)) == named.equivalent.end())
        named.equivalent.push_back(name_of(rival));
    for (auto const& one : move.numbers)
      named.parameters.push_back(
          {(subject.is_of_command() ? named.name : one.name) + number, one.unit, one.value, one.lower, one.upper});
  }
  return named;
}

NamedEffect named_move(KeptMove const& move, LoopFacts const& loop) {
  NamedEffect named = move.subject.is_of_command() ? named_command(move.subject) : named_after(*move.subject.effect);
  named.p = named.q = move.p;
  named.z = std::sqrt(std::max(move.gain, 0.0));
  return as_simulated(std::move(named), move.subject, loop);
}

bool has_name(std::vector<NamedEffect> const& effects, std::string const& name) {
  return std::any_of(effects.begin(), effects.end(), [&](NamedEffect const& one) { return one.name == name; });
}

}  // namespace

void keep_standing(JointDiagnosis& joint, DecisionFacts const& scan, LoopFacts const& loop,
                   StandingNames const& names) {
  if (!names.by_loop) return;
  std::vector<NamedEffect> standing;
  bool const keeps_delay = scan.delay.is_named && names.has_delay && !names.command_delay;
  for (auto& named : joint.effects) {
    Effect const* effect = nullptr;
    bool stands = false;
    for (std::size_t i = 0; i < scan.accepted.size(); ++i) {
      if (scan.accepted[i].effect->name() != named.name) continue;
      effect = scan.accepted[i].effect;
      stands = stands || names.effects[i];
    }
    bool const is_simulated = effect != nullptr && names.of_other_model && loop.is_kept({effect});
    if (effect != nullptr ? stands : keeps_delay)
      standing.push_back(is_simulated ? as_simulated(std::move(named), {effect}, loop) : std::move(named));
  }
  for (auto const& move : loop.kept) {
    bool const is_delay = move.subject.is_of_command() && move.subject.key == LoopKey::command_delay_s;
    bool const is_added = std::any_of(names.added.begin(), names.added.end(),
                                      [&](KeptMove const& one) { return one.subject == move.subject; });
    NamedEffect named = named_move(move, loop);
    if ((is_delay || is_added) && !has_name(standing, named.name)) standing.push_back(std::move(named));
  }
  joint.effects = std::move(standing);
  if (!names.of_other_model) return;
  // the scan's model is none of these names': numbers and errors are the simulations' own, or none
  joint.augmented.clear();
  for (auto const& one : loop.numbers)
    if (!one.name.starts_with("loop_"))
      joint.augmented.push_back({one.name, one.unit, one.value, one.lower, one.upper});
  joint.augmented_train_relerr = joint.augmented_cv_relerr = joint.augmented_validation_relerr = unknown;
}

bool is_lower(DecisionFacts const& scan, LoopFacts const& loop, double least_fall) {
  // what happens once, or runs by itself, may not be in the recordings to predict
  bool const is_of_clock = std::all_of(scan.accepted.begin(), scan.accepted.end(),
                                       [](EffectFacts const& facts) { return is_clock_bound(*facts.effect); });
  auto const judged = [&](ModelErrors const& errors) {
    return is_of_clock && !scan.accepted.empty() ? errors.held_out : errors.judged();
  };
  // rows that say little may not be predicted worse, either
  if (!loop.decides() || loop.kept.empty())
    return judged(scan.weighed_final) <= (1.0 - least_fall) * judged(scan.weighed_baseline) &&
           scan.final.judged() <= scan.baseline.judged();
  LoopErrors const& before = loop.has_validation ? loop.base_validation : loop.base_train;
  LoopErrors const& after = loop.has_validation ? loop.final_validation : loop.final_train;
  return after.both() <= (1.0 - least_fall) * before.both();
}

}  // namespace torquescope
