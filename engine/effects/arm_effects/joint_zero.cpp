// An encoder whose zero is not where the robot file has it, as the joint's own rigid torque shows it.
//
// Equation   tau = z d(y_j(q, dq, ddq) chi) / dq_j, z: the error of the zero [rad or m], small
// Source     Hollerbach, Khalil, Gautier 2016, Springer Handbook of Robotics, section 6.2 (joint offsets)

#include "engine/effects/given_effect.hpp"

namespace torquescope::effects {

Effect const& joint_zero() {
  static GivenEffect const effect({.name = "joint_zero",
                                   .title = "an encoder's zero that differs from the robot file's",
                                   .equation = "z d(tau_rigid)/dq",
                                   .source = "Hollerbach, Khalil, Gautier 2016, section 6.2",
                                   .separated_by = "slow motions through poses all over the joint's range",
                                   .parameters = {{"zero", "rad", "m", {-0.5}, {0.5}}},
                                   .families = {EffectFamily::static_position},
                                   .signature = {SignatureAxis::position},
                                   .is_of_whole_arm = true});
  return effect;
}

}  // namespace torquescope::effects
