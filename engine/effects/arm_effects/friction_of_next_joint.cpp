// Friction of the next joint towards the tip, felt through a common transmission.
//
// Equation   tau = b dq_(j+1) + c sign(dq_(j+1))
// Why        wrists drive two axes through one hollow shaft or bevel gears: a motor carries part of its neighbour's
//            friction
// Source     Hollerbach, Khalil, Gautier 2016, Springer Handbook of Robotics, section 6.3 (coupled transmissions)

#include "engine/effects/given_effect.hpp"

namespace torquescope::effects {

Effect const& friction_of_next_joint() {
  static GivenEffect const effect(
      {.name = "friction_of_next_joint",
       .title = "friction of the next joint through a common transmission",
       .equation = "b dq_next + c sign(dq_next)",
       .source = "Hollerbach, Khalil, Gautier 2016, Springer Handbook of Robotics, section 6.3",
       .separated_by = "a motion in which this joint moves while the next one rests",
       .parameters = {{"next_viscous", "N m s/rad", "N s/rad"}, {"next_coulomb", "N m", "N"}},
       .families = {EffectFamily::outside},
       .signature = {SignatureAxis::time}});
  return effect;
}

}  // namespace torquescope::effects
