// Friction of the joint before, towards the base, felt through a common transmission.
//
// Equation   tau = b dq_(j-1) + c sign(dq_(j-1))
// Why        wrists drive two axes through one hollow shaft or bevel gears: a motor carries part of its neighbour's
//            friction
// Source     Hollerbach, Khalil, Gautier 2016, Springer Handbook of Robotics, section 6.3 (coupled transmissions)

#include "engine/effects/given_effect.hpp"

namespace torquescope::effects {

Effect const& friction_of_previous_joint() {
  static GivenEffect const effect(
      {.name = "friction_of_previous_joint",
       .title = "friction of the previous joint through a common transmission",
       .equation = "b dq_previous + c sign(dq_previous)",
       .source = "Hollerbach, Khalil, Gautier 2016, Springer Handbook of Robotics, section 6.3",
       .separated_by = "a motion in which this joint moves while the previous one rests",
       .parameters = {{"previous_viscous", "N m s/rad", "N s/rad"}, {"previous_coulomb", "N m", "N"}},
       .families = {EffectFamily::outside},
       .signature = {SignatureAxis::time}});
  return effect;
}

}  // namespace torquescope::effects
