// A joint whose link turns by load / stiffness against its encoder: the lag of one link is felt by all joints.
//
// Equation   tau = - c d(tau_links)(l, l', l''), of joint i: l what its spring carries, c its compliance, d() how the
//            rigid torque of all joints changes where joint i is moved along position, speed and acceleration. First
//            order in c: for motions well below the resonance
//            A model that has the drive's inertia J in a link's: l - J ddq in place of l, and its own lag taken back,
//            with parameters c J and c J^2
// Needs      an encoder at the motor: one at the link sees the lag itself
// Confused   joint_zero where the load hardly changes; joint_elasticity, which sees one joint alone and its resonance
// Source     Spong 1987, doi:10.1115/1.3143860, the limit of stiff springs

#include "engine/effects/given_effect.hpp"

namespace torquescope::effects {

Effect const& joint_compliance() {
  static GivenEffect const effect({.name = "joint_compliance",
                                   .title = "a transmission that winds up under its load, felt by all joints",
                                   .equation = "- c d(tau_links)(l, l', l'')",
                                   .source = "Spong 1987, doi:10.1115/1.3143860",
                                   .separated_by = "fast motions of one joint, with heavy and with light load",
                                   .parameters = {{"compliance", "rad/(N m)", "m/N", {0.0}},
                                                  {"compliance_inertia", "s2", "s2"},
                                                  {"compliance_inertia2", "kg m2 s2", "kg s2"}},
                                   .families = {EffectFamily::acceleration},
                                   .signature = {SignatureAxis::acceleration, SignatureAxis::frequency},
                                   .is_of_whole_arm = true});
  return effect;
}

}  // namespace torquescope::effects
