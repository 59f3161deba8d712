// Friction that wanders or steps: wear, a loosening preload, grease that moves.
//
// Equation   tau = (t - start) (s d_c + d_v dq) + s d_s [t >= t_c]; s = sign(dq) weighted by the Coulomb levels
// Parameters friction_drift_coulomb d_c [N m/s; N/s], friction_drift_viscous d_v [N m/rad; N/m],
//            friction_step d_s [N m; N], either sign; friction_step_time t_c [s]
// Signature  time, odd in the velocity: a ramp or a step
// Confused   thermal_friction
// Source     Bittencourt, Axelsson 2014 (wear)

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class FrictionDrift final : public InstantEffect {
 public:
  FrictionDrift()
      : InstantEffect(
            {.name = "friction_drift",
             .title = "friction that wanders or steps in time",
             .equation = "(t - start) (s d_c + d_v dq) + s d_s [t >= t_c]",
             .source = "Bittencourt, Axelsson 2014",
             .separated_by = "the same motion again after a rest",
             .parameters = {{"friction_drift_coulomb",
                             "N m/s",
                             "N/s",
                             {-1.0, RelativeTo::coulomb_per_duration},
                             {1.0, RelativeTo::coulomb_per_duration}},
                            {"friction_drift_viscous",
                             "N m/rad",
                             "N/m",
                             {-1.0, RelativeTo::viscous_per_duration},
                             {1.0, RelativeTo::viscous_per_duration}},
                            {"friction_step", "N m", "N", {-1.0, RelativeTo::coulomb}, {1.0, RelativeTo::coulomb}},
                            shape_parameter("friction_step_time", "s", "s", {0.05, RelativeTo::instant},
                                            {0.95, RelativeTo::instant}, Spacing::linear)},
             .families = {EffectFamily::time},
             .signature = {SignatureAxis::time, SignatureAxis::velocity},
             .parity = Parity::odd,
             .is_dry_friction = true}) {}

 private:
  void law(JointStates const& at, std::span<double const> shape, JointScales const& scales,
           LawColumns out) const override {
    Scratch const s = friction_sign(at.dq, scales), elapsed_s = at.time_s - scales.start_s;
    out.col(0) = elapsed_s * s;
    out.col(1) = elapsed_s * at.dq;
    out.col(2) = is_after(at.time_s, shape[0]) * s;
  }
};

}  // namespace

Effect const& friction_drift() {
  static FrictionDrift const effect;
  return effect;
}

}  // namespace torquescope::effects
