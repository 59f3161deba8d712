// Friction that wanders or steps: wear, a loosening preload, grease that moves.
//
// Equation   tau = (t - start) (s d_c + d_v dq) + s d_s [t >= t_c] + s sum_k w_k P_k(x), k = 2 to 6; s = sign(dq)
//            weighted by the Coulomb levels, x from -1 to 1 over the recording, P_k Legendre's polynomials
// Parameters friction_drift_coulomb d_c [N m/s; N/s], friction_drift_viscous d_v [N m/rad; N/m],
//            friction_step d_s [N m; N], friction_wander_k w_k [N m; N], either sign; friction_step_time t_c [s]
// Signature  time, odd in the velocity: a ramp, a step, or a wander
// Why        a level that walks is no ramp and no step, and leaves as much as either explains. Polynomials that are
//            orthogonal to the level and to the ramp leave their values alone; up to the sixth they hold nine tenths of
//            a walk
// Confused   thermal_friction
// Source     Bittencourt, Axelsson 2014 (wear)

#include <fmt/format.h>

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

constexpr int first_wander = 3, lowest_degree = 2, highest_degree = 6;  // column of the lowest degree

EffectParameter wander(int degree) {
  return {
      fmt::format("friction_wander_{}", degree), "N m", "N", {-1.0, RelativeTo::coulomb}, {1.0, RelativeTo::coulomb}};
}

class FrictionDrift final : public InstantEffect {
 public:
  FrictionDrift()
      : InstantEffect(
            {.name = "friction_drift",
             .title = "friction that wanders or steps in time",
             .equation = "(t - start) (s d_c + d_v dq) + s d_s [t >= t_c] + s sum w_k P_k(x), k = 2 to 6, x = -1 to 1 "
                         "over the time",
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
                            wander(2),
                            wander(3),
                            wander(4),
                            wander(5),
                            wander(6),
                            shape_parameter("friction_step_time", "s", "s", {0.05, RelativeTo::instant},
                                            {0.95, RelativeTo::instant}, Spacing::linear)},
             .families = {EffectFamily::time},
             .signature = {SignatureAxis::time, SignatureAxis::velocity},
             .parity = Parity::odd,
             .is_dry_friction = true}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const& scales,
                EffectColumns out) const override {
    Scratch const s = friction_sign(at.dq, scales), elapsed_s = at.time_s - scales.start_s;
    out.col(0) = elapsed_s * s;
    out.col(1) = elapsed_s * at.dq;
    out.col(2) = is_after(at.time_s, shape[0]) * s;
    Scratch const x = 2.0 / scales.duration_s * elapsed_s - 1.0;
    Scratch before = Scratch::Ones(x.size()), here = x;  // Bonnet's recursion
    for (int k = 1; k < highest_degree; ++k) {
      Scratch const next = ((2 * k + 1) * x * here - k * before) / (k + 1);
      before = here;
      here = next;
      if (k + 1 >= lowest_degree) out.col(first_wander + k + 1 - lowest_degree) = s * here;
    }
  }
};

}  // namespace

Effect const& friction_drift() {
  static FrictionDrift const effect;
  return effect;
}

}  // namespace torquescope::effects
