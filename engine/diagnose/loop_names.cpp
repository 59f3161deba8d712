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

NamedEffect named_move(KeptMove const& move) {
  NamedEffect named = move.subject.is_of_command() ? named_command(move.subject) : named_after(*move.subject.effect);
  named.p = named.q = move.p;
  named.z = std::sqrt(std::max(move.gain, 0.0));
  for (auto const& rival : move.rivals) named.equivalent.push_back(name_of(rival));
  for (auto const& one : move.numbers)
    named.parameters.push_back(
        {move.subject.is_of_command() ? named.name : one.name, one.unit, one.value, one.lower, one.upper});
  return named;
}

}  // namespace

void keep_standing(JointDiagnosis& joint, DecisionFacts const& scan, LoopFacts const& loop,
                   StandingNames const& names) {
  if (!names.by_loop) return;
  std::vector<NamedEffect> standing;
  bool const had_all = std::find(names.effects.begin(), names.effects.end(), false) == names.effects.end();
  bool const keeps_delay = scan.delay.is_named && names.has_delay && !names.command_delay;
  for (auto& effect : joint.effects) {
    bool is_effect = false, stands = false;
    // waves of one effect are one name
    for (std::size_t i = 0; i < scan.accepted.size(); ++i) {
      if (scan.accepted[i].effect->name() != effect.name) continue;
      is_effect = true;
      stands = stands || names.effects[i];
    }
    if (is_effect ? stands : keeps_delay) standing.push_back(std::move(effect));
  }
  for (auto const& move : loop.kept) {
    bool const is_delay = move.subject.is_of_command() && move.subject.key == LoopKey::command_delay_s;
    bool const is_added = std::any_of(names.added.begin(), names.added.end(),
                                      [&](KeptMove const& one) { return one.subject == move.subject; });
    if (is_delay || is_added) standing.push_back(named_move(move));
  }
  joint.effects = std::move(standing);
  if (had_all && names.added.empty()) return;
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
