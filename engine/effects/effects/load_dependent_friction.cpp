// Dry friction in proportion to the load that gears and bearings carry.
//
// Equation   tau = s mu (sqrt(l^2 + p^2) - p), l = tau_load - (1 - k) J ddq; tau_load: gravity and inertia of the
//            baseline; s = sign(dq) weighted by the Coulomb levels of the baseline
// Preload    a bearing rubs by the resultant of load and preload p; friction s mu p at no load is the baseline's
// Parameters load_dependent_friction mu >= 0 [1], up to 0.3; load_friction_inertia_share k [1]: share of the inertia J
//            behind the gear (a rotor presses no teeth; 1 where inertia is all the load, since mu k is one number
//            there); load_friction_preload p [N m; N]: as a torque of the load, up to the recording's rms; 0: mu |l|
//            At the most it is a square of the load, and rows cannot tell more from it
// Signature  load, odd in the velocity
// Confused   position_dependent_friction when gravity is the load, directional_efficiency, torque_constant
// Source     Hamon, Gautier, Garrec, Janot 2010, IEEE/RSJ IROS; model M3 of BAM (Rhoban, Better Actuator Models);
//            Palmgren 1959, Ball and Roller Bearing Engineering

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class LoadDependentFriction final : public InstantEffect {
 public:
  LoadDependentFriction()
      : InstantEffect({.name = "load_dependent_friction",
                       .title = "dry friction in proportion to the load",
                       .equation = "s mu (sqrt(l^2 + p^2) - p), l = tau_load - (1 - k) J ddq",
                       .source = "Hamon, Gautier, Garrec, Janot 2010; BAM model M3; Palmgren 1959 (preload)",
                       .separated_by = "the same motion with another payload",
                       .parameters = {{"load_dependent_friction", "1", "1", {0.0}, {0.3}},
                                      effect_at_both(shape_parameter("load_friction_inertia_share", "1", "1",
                                                                     {1.0, RelativeTo::bears_only_inertia}, {1.0},
                                                                     Spacing::linear)),
                                      effect_at_upper(
                                          none_at_lower(shape_parameter("load_friction_preload", "N m", "N", {0.0},
                                                                        {1.0, RelativeTo::torque}, Spacing::linear)))},
                       .families = {EffectFamily::load},
                       .signature = {SignatureAxis::load, SignatureAxis::velocity},
                       .parity = Parity::odd,
                       .needs_baseline = true,
                       .is_dry_friction = true,
                       .code = "friction_sign * load_dependent_friction "
                               "* (sqrt(pow(load - (1 - load_friction_inertia_share) * baseline_inertia * ddq, 2) "
                               "+ pow(load_friction_preload, 2)) - load_friction_preload)"}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const& scales,
                EffectColumns out) const override {
    double const preload = shape[1];
    Scratch const load = at.load_torque - (1.0 - shape[0]) * scales.inertia * at.ddq;
    out.col(0) = friction_sign(at.dq, scales) * ((load.square() + preload * preload).sqrt() - preload);
  }
};

}  // namespace

Effect const& load_dependent_friction() {
  static LoadDependentFriction const effect;
  return effect;
}

}  // namespace torquescope::effects
