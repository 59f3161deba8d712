// Someone or something pushes for a while.
//
// Equation   tau = a sin^2(pi (t - t_0) / w) for t_0 < t < t_0 + w
// Parameters contact a [N m; N], either sign; contact_start t_0, contact_width w [s]
//            not in the first and last moments: what came before the recording, a long rest above all, is not in it
// Signature  time: one stretch, not repeated, whatever the motion
// Confused   sensor_drift
// Source     De Luca, Mattone 2005 (momentum observer; the push itself is not modelled there)

#include <numbers>

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class Contact final : public InstantEffect {
 public:
  Contact()
      : InstantEffect(
            {.name = "contact",
             .title = "a push from outside for a while",
             .equation = "a sin^2(pi (t - t_0) / w), t_0 < t < t_0 + w",
             .source = "De Luca, Mattone 2005",
             .separated_by = "the same lap again",
             .parameters = {{"contact", "N m", "N", {-10.0, RelativeTo::torque}, {10.0, RelativeTo::torque}},
                            shape_parameter("contact_start", "s", "s", {0.02, RelativeTo::instant},
                                            {0.98, RelativeTo::instant}, Spacing::linear),
                            effect_at_lower(shape_parameter("contact_width", "s", "s", {5.0, RelativeTo::filter_time},
                                                            {0.2, RelativeTo::duration}, Spacing::logarithmic))},
             .families = {EffectFamily::outside, EffectFamily::time},
             .signature = {SignatureAxis::time},
             .parity = Parity::even}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const&,
                EffectColumns out) const override {
    Scratch const phase = (at.time_s - shape[0]) / shape[1];
    Scratch cosine(phase.size());
    auto wave = out.col(0);
    cosine_sine(std::numbers::pi, phase, cosine, wave);
    wave = (phase > 0.0 && phase < 1.0).select(wave.square(), 0.0);
  }
};

}  // namespace

Effect const& contact() {
  static Contact const effect;
  return effect;
}

}  // namespace torquescope::effects
