#pragma once
// Laws of an instant or a clock: what they say belongs to the recording they were fitted to.
//
// Which      what begins at an instant, waves per second, everything of the family time
// So         they predict no torque of another recording, are tried after all laws of the motion, on stretches as short
//            as the filter's memory, and are named only with an adequate model
// Elsewhere  friction that goes with time since the start runs down in another recording as well, but nobody says how
//            far it had gone: a share of it is a nuisance of that recording
// Threads    free functions
// Source     engine/inference/THEORY.md, Laws of a clock

#include <algorithm>

#include "engine/effects/effect.hpp"

namespace torquescope {

inline bool is_clock_bound(Effect const& effect) {
  auto const& parameters = effect.parameters();
  bool const has_frequency =
      std::any_of(parameters.begin(), parameters.end(), [](auto const& one) { return one.is_frequency(); });
  return effect.is_event() || effect.family() == EffectFamily::time || (effect.is_wave() && has_frequency);
}

// what a law says of the rows of another recording
enum class Elsewhere { the_same, a_share, nothing };

inline Elsewhere elsewhere(Effect const& effect) {
  if (!is_clock_bound(effect)) return Elsewhere::the_same;
  bool const runs_down = effect.family() == EffectFamily::time && !effect.is_event();
  return runs_down && effect.acts_on() == ActsOn::joint ? Elsewhere::a_share : Elsewhere::nothing;
}

}  // namespace torquescope
