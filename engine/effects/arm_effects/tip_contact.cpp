// A force on the last link for a part of a recording, constant in the base frame: the arm leans on something.
//
// Equation   tau = -J(q)' F [t_1 <= t < t_2] at every joint; J: Jacobian of the flange, F: force on the arm
//            there [N]
// Source     Haddadin, De Luca, Albu-Schaeffer 2017, doi:10.1109/TRO.2017.2723903

#include "engine/effects/given_effect.hpp"

namespace torquescope::effects {

Effect const& tip_contact() {
  static GivenEffect const effect({.name = "tip_contact",
                                   .title = "a constant force on the last link for some time",
                                   .equation = "-J(q)' F [t_1 <= t < t_2]",
                                   .source = "Haddadin, De Luca, Albu-Schaeffer 2017, doi:10.1109/TRO.2017.2723903",
                                   .separated_by = "the same motion without contact",
                                   .parameters = {{"force_x", "N", "N"},
                                                  {"force_y", "N", "N"},
                                                  {"force_z", "N", "N"},
                                                  shape_parameter("contact_from", "s", "s", {0.0, RelativeTo::instant},
                                                                  {1.0, RelativeTo::instant}, Spacing::linear),
                                                  shape_parameter("contact_until", "s", "s", {0.0, RelativeTo::instant},
                                                                  {1.0, RelativeTo::instant}, Spacing::linear)},
                                   .families = {EffectFamily::outside, EffectFamily::time},
                                   .signature = {SignatureAxis::time, SignatureAxis::position},
                                   .is_of_whole_arm = true});
  return effect;
}

}  // namespace torquescope::effects
