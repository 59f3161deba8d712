// Stribeck friction: friction above the Coulomb level that fades as the joint gets faster and a film of oil builds up.
//
// Equation   tau = s Fs exp(-(|dq| / vs)^delta); s = sign(dq) weighted by the Coulomb levels of the baseline
// Parameters stribeck Fs >= 0 [N m; N], up to twice the Coulomb level
//            stribeck_speed vs [rad/s; m/s], stribeck_exponent delta [1]: 1 Tustin, 2 Gauss
// Signature  velocity below 2 vs, odd, alike while speeding up and slowing down
// Confused   presliding, power_law_viscous below 1, the filter's own artefact at reversals
// Source     Armstrong-Helouvry 1991; Bittencourt, Gunnarsson 2012

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class Stribeck final : public InstantEffect {
 public:
  Stribeck()
      : InstantEffect(
            {.name = "stribeck",
             .title = "Stribeck friction: falls with speed just above rest",
             .equation = "s Fs exp(-(|dq| / vs)^delta)",
             .source = "Armstrong-Helouvry 1991, Control of Machines with Friction; Bittencourt, Gunnarsson 2012",
             .separated_by =
                 "creep plateaus at five to eight speeds below three times the Stribeck speed, constant speed",
             .parameters = {{"stribeck", "N m", "N", {0.0}, {2.0, RelativeTo::coulomb}},
                            shape_parameter("stribeck_speed", "rad/s", "m/s", {0.002, RelativeTo::peak_speed},
                                            {0.2, RelativeTo::peak_speed}, Spacing::logarithmic),
                            effect_at_upper(
                                shape_parameter("stribeck_exponent", "1", "1", {0.5}, {2.0}, Spacing::linear))},
             .families = {EffectFamily::reversal, EffectFamily::velocity_law},
             .signature = {SignatureAxis::velocity, SignatureAxis::since_velocity_reversal},
             .parity = Parity::odd,
             .is_dry_friction = true,
             .code = "friction_sign * stribeck * exp(-pow(fabs(dq) / stribeck_speed, stribeck_exponent))"}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const& scales,
                EffectColumns out) const override {
    fade(at, shape[0], shape[1], scales, out);
  }

  void evaluate_each(JointStates const& at, ParametersOfEach const& shapes, JointScales const& scales,
                     EffectColumns out) const override {
    fade(at, NumberOfEach(shapes.col(0)), NumberOfEach(shapes.col(1)), scales, out);
  }

  template <typename Number>
  static void fade(JointStates const& at, Number const& speed, Number const& exponent, JointScales const& scales,
                   EffectColumns out) {
    auto faded = out.col(0);
    faded = at.dq / speed;
    power_of_size(faded, exponent);
    faded = -faded;
    exponential(faded);
    faded *= friction_sign(at.dq, scales);
  }
};

}  // namespace

Effect const& stribeck() {
  static Stribeck const effect;
  return effect;
}

}  // namespace torquescope::effects
