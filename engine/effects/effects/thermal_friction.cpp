// Friction that changes while the joint warms up.
//
// Equation   tau = x (s c_c + c_v dq), x = exp(-(t - start) / tau_T); s = sign(dq) weighted by the Coulomb levels
// Parameters thermal_coulomb c_c [N m; N], thermal_viscous c_v [N m s/rad; N s/m]: cold minus warm, either sign
//            thermal_time tau_T [s]; twice the duration is nearly a line: all that the rows can tell
// Signature  time, odd in the velocity: laps drift apart and settle
// Confused   friction_drift; any friction effect when slow and fast stretches are not interleaved in time
// Source     Simoni, Beschi, Legnani, Visioli 2015; Bittencourt, Gunnarsson 2012

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class ThermalFriction final : public InstantEffect {
 public:
  ThermalFriction()
      : InstantEffect(
            {.name = "thermal_friction",
             .title = "friction that changes while the joint warms up",
             .equation = "exp(-t / tau_T) (s c_c + c_v dq)",
             .source = "Simoni, Beschi, Legnani, Visioli 2015; Bittencourt, Gunnarsson 2012",
             .separated_by = "a periodic motion for twice the warm-up time, from cold and from warm, fast and slow "
                             "laps interleaved",
             .parameters =
                 {{"thermal_coulomb", "N m", "N", {-1.0, RelativeTo::coulomb}, {1.0, RelativeTo::coulomb}},
                  {"thermal_viscous", "N m s/rad", "N s/m", {-1.0, RelativeTo::viscous}, {1.0, RelativeTo::viscous}},
                  effect_at_upper(shape_parameter("thermal_time", "s", "s", {0.05, RelativeTo::duration},
                                                  {2.0, RelativeTo::duration}, Spacing::logarithmic))},
             .families = {EffectFamily::time},
             .signature = {SignatureAxis::time, SignatureAxis::velocity},
             .parity = Parity::odd,
             .is_dry_friction = true}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const& scales,
                EffectColumns out) const override {
    Scratch cold = (at.time_s - scales.start_s) / -shape[0];
    exponential(cold);
    out.col(0) = cold * friction_sign(at.dq, scales);
    out.col(1) = cold * at.dq;
  }
};

}  // namespace

Effect const& thermal_friction() {
  static ThermalFriction const effect;
  return effect;
}

}  // namespace torquescope::effects
