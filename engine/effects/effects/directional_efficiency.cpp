// Losses of a transmission that differ between driving the load and being driven by it.
//
// Equation   tau = s K |tau_motor - rho (tau_load - (1 - k) J ddq)|; s = sign(dq) weighted by the Coulomb levels of the
//            baseline
// Parameters directional_efficiency K >= 0 [1], up to 0.5; backdrive_ratio rho [1]: 0, losses follow the motor's side;
//            efficiency_inertia_share k [1]: of the inertia J, behind the gear; 1 where inertia is all the load
// Signature  load: jumps where the sign of tau_load dq flips
// Confused   load_dependent_friction, and nothing tells them apart by the load alone: for moving joints
//            s |tau_load| [driving] - s |tau_load| [driven] = tau_load is a column of the baseline already
// Source     BAM models M5, M6; Giberti, Cinquemani, Legnani 2010

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class DirectionalEfficiency final : public InstantEffect {
 public:
  DirectionalEfficiency()
      : InstantEffect({.name = "directional_efficiency",
                       .title = "losses that differ between driving and being driven",
                       .equation = "s K |tau_motor - rho (tau_load - (1 - k) J ddq)|",
                       .source = "BAM models M5, M6; Giberti, Cinquemani, Legnani 2010",
                       .separated_by = "all four quadrants of torque and speed: lift and lower a load",
                       .parameters = {{"directional_efficiency", "1", "1", {0.0}, {0.5}},
                                      shape_parameter("backdrive_ratio", "1", "1", {0.0}, {2.0}, Spacing::linear),
                                      effect_at_both(shape_parameter("efficiency_inertia_share", "1", "1",
                                                                     {1.0, RelativeTo::bears_only_inertia}, {1.0},
                                                                     Spacing::linear))},
                       .families = {EffectFamily::load},
                       .signature = {SignatureAxis::load, SignatureAxis::velocity},
                       .parity = Parity::neither,
                       .needs_baseline = true,
                       .is_dry_friction = true}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const& scales,
                EffectColumns out) const override {
    auto const rotor = (1.0 - shape[1]) * scales.inertia * at.ddq;
    out.col(0) = friction_sign(at.dq, scales) * (at.motor_torque - shape[0] * (at.load_torque - rotor)).abs();
  }
};

}  // namespace

Effect const& directional_efficiency() {
  static DirectionalEfficiency const effect;
  return effect;
}

}  // namespace torquescope::effects
