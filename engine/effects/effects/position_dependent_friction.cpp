// Dry friction that changes along the travel: a bent shaft, uneven preload, a worn stretch.
//
// Equation   tau = s (a1 q + a_c cos(k q) + a_s sin(k q)); s = sign(dq) weighted by the Coulomb levels of the baseline
// Parameters position_friction_slope a1 [N m/rad; N/m], position_friction_cos, _sin [N m; N], either sign
//            position_friction_order k [1/rad; 1/m]: half a wave to eight waves over the travel
//            The slope carries what longer waves do, so that half a wave is all that the travel can tell
// Signature  position, odd in the velocity
// Confused   load_dependent_friction under gravity; gravity when the Coulomb levels of the directions differ
// Source     Bittencourt, Gunnarsson 2012 (dependence on the angle)

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class PositionDependentFriction final : public InstantEffect {
 public:
  PositionDependentFriction()
      : InstantEffect(
            {.name = "position_dependent_friction",
             .title = "dry friction that changes along the travel",
             .equation = "s (a1 q + a_c cos(k q) + a_s sin(k q))",
             .source = "Bittencourt, Gunnarsson 2012",
             .separated_by = "the same positions in both directions at two or more speeds",
             .parameters =
                 {{"position_friction_slope",
                   "N m/rad",
                   "N/m",
                   {-1.0, RelativeTo::coulomb_per_range},
                   {1.0, RelativeTo::coulomb_per_range}},
                  {"position_friction_cos", "N m", "N", {-0.5, RelativeTo::coulomb}, {0.5, RelativeTo::coulomb}},
                  {"position_friction_sin", "N m", "N", {-0.5, RelativeTo::coulomb}, {0.5, RelativeTo::coulomb}},
                  effect_at_lower(shape_parameter("position_friction_order", "1/rad", "1/m",
                                                  {0.5, RelativeTo::lowest_order}, {8.0, RelativeTo::lowest_order},
                                                  Spacing::logarithmic))},
             .families = {EffectFamily::static_position, EffectFamily::load},
             .signature = {SignatureAxis::position, SignatureAxis::velocity},
             .parity = Parity::odd,
             .is_dry_friction = true,
             .is_level_free = true,
             .code = "friction_sign * (position_friction_slope * q "
                     "+ position_friction_cos * cos(position_friction_order * q) "
                     "+ position_friction_sin * sin(position_friction_order * q))"}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const& scales,
                EffectColumns out) const override {
    Scratch const s = friction_sign(at.dq, scales);
    cosine_sine(shape[0], at.q, out.col(1), out.col(2));
    out.col(0) = s * at.q;
    out.col(1) *= s;
    out.col(2) *= s;
  }
};

}  // namespace

Effect const& position_dependent_friction() {
  static PositionDependentFriction const effect;
  return effect;
}

}  // namespace torquescope::effects
