// Weight along a direction that the robot file does not say: the arm stands on a tilted base.
//
// Equation   tau = t_1 y_j(q, 0, 0; |g| e_1) chi + t_2 y_j(q, 0, 0; |g| e_2) chi, e_1, e_2 at right angles to gravity
//            of the file; t: tilt of the base [rad], small. chi: base parameters, which say nothing of what weighs on
//            no joint along the file's gravity: a first joint that stands upright feels a little more
// Source     Hollerbach, Khalil, Gautier 2016, Springer Handbook of Robotics, section 6.3 (gravity in the base frame)

#include "engine/effects/given_effect.hpp"

namespace torquescope::effects {

Effect const& gravity_direction() {
  static GivenEffect const effect(
      {.name = "gravity_direction",
       .title = "a base that is tilted against the robot file's gravity",
       .equation = "t_1 tau_g(q; e_1) + t_2 tau_g(q; e_2)",
       .source = "Hollerbach, Khalil, Gautier 2016, section 6.3",
       .separated_by = "slow motions through poses all over the workspace",
       .parameters = {{"tilt_1", "rad", "rad", {-0.5}, {0.5}}, {"tilt_2", "rad", "rad", {-0.5}, {0.5}}},
       .families = {EffectFamily::static_position},
       .signature = {SignatureAxis::position},
       .is_of_whole_arm = true});
  return effect;
}

}  // namespace torquescope::effects
