// A torque of fixed frequency from outside: a pump, a fan, a neighbouring machine.
//
// Equation   tau = a_s sin(2 pi f (t - start)) + a_c cos(2 pi f (t - start))
// Parameters periodic_disturbance_sin a_s, periodic_disturbance_cos a_c [N m; N], either sign;
//            disturbance_frequency f [Hz]: below three periods a recording cannot tell it from anything smooth
// Signature  frequency: a narrow line, whatever speed and angle
// Confused   cogging at a single speed
// Source     definition of a sinusoid in time

#include <numbers>

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class PeriodicDisturbance final : public InstantEffect {
 public:
  PeriodicDisturbance()
      : InstantEffect(
            {.name = "periodic_disturbance",
             .title = "torque of fixed frequency from outside",
             .equation = "a_s sin(2 pi f t) + a_c cos(2 pi f t)",
             .source = "definition of a sinusoid in time",
             .separated_by = "the same motion at several speeds",
             .parameters =
                 {{"periodic_disturbance_sin", "N m", "N", {-3.0, RelativeTo::torque}, {3.0, RelativeTo::torque}},
                  {"periodic_disturbance_cos", "N m", "N", {-3.0, RelativeTo::torque}, {3.0, RelativeTo::torque}},
                  shape_parameter("disturbance_frequency", "Hz", "Hz", {3.0, RelativeTo::slowest_frequency},
                                  {1.0, RelativeTo::cutoff_frequency}, Spacing::linear)},
             .families = {EffectFamily::outside, EffectFamily::order_locked},
             .signature = {SignatureAxis::frequency, SignatureAxis::time},
             .parity = Parity::even}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const& scales,
                EffectColumns out) const override {
    Scratch const elapsed_s = at.time_s - scales.start_s;
    cosine_sine(2.0 * std::numbers::pi * shape[0], elapsed_s, out.col(1), out.col(0));
  }
};

}  // namespace

Effect const& periodic_disturbance() {
  static PeriodicDisturbance const effect;
  return effect;
}

}  // namespace torquescope::effects
