// Inertia that this joint feels when the next one accelerates, beside the rigid links: a rotor or a coupled drive.
//
// Equation   tau = J ddq_(j+1)
// Why        a fast rotor whose axis is not at a right angle to this joint's, or a transmission that two motors share
// Source     Khalil, Dombre 2002, Modeling, Identification and Control of Robots, section 9.2 (inertia of rotors)

#include "engine/effects/given_effect.hpp"

namespace torquescope::effects {

Effect const& inertia_of_next_joint() {
  static GivenEffect const effect({.name = "inertia_of_next_joint",
                                   .title = "inertia shared with the drive of the next joint",
                                   .equation = "J ddq_next",
                                   .source = "Khalil, Dombre 2002, section 9.2",
                                   .separated_by = "a motion in which the next joint alone accelerates",
                                   .parameters = {{"next_inertia", "kg m^2", "kg m"}},
                                   .families = {EffectFamily::outside},
                                   .signature = {SignatureAxis::time}});
  return effect;
}

}  // namespace torquescope::effects
