// A torque channel that cannot show more than its limit, while the joint gets what it needs.
//
// Equation   recorded = true + c (clamp(true, -L, L) - true)
// Parameters clipping c [1] from 0 to 1, 1 when nothing passes; clipping_limit L [N m; N]
// Signature  load: flat tops
// Confused   torque_constant
// Source     definition of saturation; PHYSICS.md A4

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class Clipping final : public InstantEffect {
 public:
  Clipping()
      : InstantEffect({.name = "clipping",
                       .title = "torque channel that clips at a limit",
                       .equation = "recorded torque + c (clamp(tau_motor, -L, L) - tau_motor)",
                       .source = "definition of saturation",
                       .separated_by = "a gentler motion, and a log of the saturation flag",
                       .parameters = {{"clipping", "1", "1", {0.0}, {1.0}},
                                      shape_parameter("clipping_limit", "N m", "N", {0.5, RelativeTo::torque_peak},
                                                      {1.0, RelativeTo::torque_peak}, Spacing::linear)},
                       .families = {EffectFamily::measurement, EffectFamily::load},
                       .signature = {SignatureAxis::load},
                       .parity = Parity::neither,
                       .acts_on = ActsOn::recorded_torque,
                       .needs_baseline = true}) {}

 private:
  void law(JointStates const& at, std::span<double const> shape, JointScales const&, LawColumns out) const override {
    out.col(0) = at.motor_torque.max(-shape[0]).min(shape[0]) - at.motor_torque;
  }
};

}  // namespace

Effect const& clipping() {
  static Clipping const effect;
  return effect;
}

}  // namespace torquescope::effects
