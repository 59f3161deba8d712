#pragma once
// Laws of an instant or a clock: what they say belongs to the recording they were fitted to.
//
// Which      what begins at an instant, waves per second, everything of the family time
// So         they predict no torque of another recording, are tried after all laws of the motion, on stretches as short
//            as the filter's memory, and are named only with an adequate model
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

}  // namespace torquescope
