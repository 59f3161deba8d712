#pragma once
// What an effect found in one recording says of another recording of the same joint.
//
// Clock-bound  effects of an instant or a clock: what begins at an instant, waves per second, everything of the family
//              time. They are tried after all effects of the motion and named only with an adequate model
// In part      a warm-up happens in another recording too, but how far it had gone at its start is not known: a share
//              of it, 0 to 1, is a nuisance parameter of that recording
// Phase        a wave over a counter keeps size and order; where the counter begins is another place in each recording.
//              A wave per second keeps its frequency: a pump runs in another recording too, or it does not
// Threads      free functions
// Source       engine/infer/decision/THEORY.md, The rules

#include <algorithm>

#include "engine/effects/effect.hpp"

namespace torquescope {

enum class CarryOver { whole, with_another_phase, in_part, in_frequency, none };

inline CarryOver carry_over(Effect const& effect) {
  auto const& parameters = effect.parameters();
  bool const is_per_second =
      std::any_of(parameters.begin(), parameters.end(), [](auto const& one) { return one.is_frequency(); });
  bool const is_of_joint = effect.acts_on() == ActsOn::joint;
  if (effect.is_event()) return CarryOver::none;
  if (effect.is_wave() && is_per_second) return CarryOver::in_frequency;
  if (effect.family() == EffectFamily::time) return is_of_joint ? CarryOver::in_part : CarryOver::none;
  bool const is_plain_wave = effect.is_wave() && effect.n_linear() == 2 && effect.n_shape() == 1;
  return is_plain_wave ? CarryOver::with_another_phase : CarryOver::whole;
}

inline bool is_clock_bound(Effect const& effect) {
  CarryOver const over = carry_over(effect);
  return over == CarryOver::in_part || over == CarryOver::in_frequency || over == CarryOver::none;
}

}  // namespace torquescope
