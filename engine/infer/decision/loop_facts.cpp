#include "engine/infer/decision/loop_facts.hpp"

#include <algorithm>
#include <cmath>

#include "engine/simulate/rollout/drive_effect.hpp"

namespace torquescope {

std::string name_of(LoopSubject const& subject) {
  if (subject.effect != nullptr) return subject.effect->name();
  return drive_effect_of(subject.key).name;
}

double LoopErrors::both() const {
  if (std::isnan(position)) return torque;
  return std::isnan(torque) ? position : std::sqrt(position * torque);
}

bool KeptMove::may_be(LoopSubject const& one) const {
  return is(one) || std::find(rivals.begin(), rivals.end(), one) != rivals.end();
}

bool LoopFacts::is_kept(LoopSubject const& subject) const {
  return std::any_of(kept.begin(), kept.end(), [&](KeptMove const& move) { return move.is(subject); });
}

bool LoopFacts::may_be_kept(LoopSubject const& subject) const {
  return std::any_of(kept.begin(), kept.end(), [&](KeptMove const& move) { return move.may_be(subject); });
}

bool LoopFacts::is_chance(LoopSubject const& subject) const {
  bool was_asked = false;
  for (auto const& step : steps)
    for (auto const& move : step.moves) {
      if (!(move.subject == subject)) continue;
      if (move.refusal != MoveRefusal::chance) return false;
      was_asked = true;
    }
  return was_asked && counts[1];
}

}  // namespace torquescope
