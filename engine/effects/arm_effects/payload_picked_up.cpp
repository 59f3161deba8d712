// A body that the last link carries for a part of a recording: picked up, or put down.
//
// Equation   tau = Phi_last(q, dq, ddq) (m, mx, my, mz, xx, ..., zz) [t_1 <= t < t_2] at every joint: the ten inertial
//            parameters of what is carried, about the frame of the last link; put down: below zero
// Source     Gaz, De Luca 2017, doi:10.1109/IROS.2017.8206152

#include "engine/effects/given_effect.hpp"

namespace torquescope::effects {

Effect const& payload_picked_up() {
  static GivenEffect const effect({.name = "payload_picked_up",
                                   .title = "a payload of the last link, picked up or put down",
                                   .equation = "Phi_last(q, dq, ddq) (m, mx, my, mz, xx, ..., zz) [t_1 <= t < t_2]",
                                   .source = "Gaz, De Luca 2017, doi:10.1109/IROS.2017.8206152",
                                   .separated_by = "the same motion before and after it",
                                   .parameters = {{"payload_mass", "kg", "kg"},
                                                  {"payload_mx", "kg m", "kg m"},
                                                  {"payload_my", "kg m", "kg m"},
                                                  {"payload_mz", "kg m", "kg m"},
                                                  {"payload_xx", "kg m2", "kg m2"},
                                                  {"payload_xy", "kg m2", "kg m2"},
                                                  {"payload_xz", "kg m2", "kg m2"},
                                                  {"payload_yy", "kg m2", "kg m2"},
                                                  {"payload_yz", "kg m2", "kg m2"},
                                                  {"payload_zz", "kg m2", "kg m2"},
                                                  shape_parameter("payload_from", "s", "s", {0.0, RelativeTo::instant},
                                                                  {1.0, RelativeTo::instant}, Spacing::linear),
                                                  shape_parameter("payload_until", "s", "s", {0.0, RelativeTo::instant},
                                                                  {1.0, RelativeTo::instant}, Spacing::linear)},
                                   .families = {EffectFamily::time, EffectFamily::outside},
                                   .signature = {SignatureAxis::time, SignatureAxis::position},
                                   .is_of_whole_arm = true});
  return effect;
}

}  // namespace torquescope::effects
