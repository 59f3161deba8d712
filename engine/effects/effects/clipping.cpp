// A torque channel that cannot show more than its limit, while the joint gets what it needs.
//
// Equation   recorded = true + c (clamp(true, -M, L) - true)
// Parameters clipping c [1] from 0 to 1, 1 when nothing passes; clipping_limit L, clipping_limit_negative M [N m; N]:
//            they differ for a channel with an offset
// Signature  load: flat tops
// Confused   torque_constant
// Source     definition of saturation

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

// what clips has been there: its limit is the extreme of the record, but for noise behind the limit
EffectParameter limit(char const* name, RelativeTo extreme) {
  return effect_at_upper(shape_parameter(name, "N m", "N", {0.8, extreme}, {1.0, extreme}, Spacing::linear));
}

class Clipping final : public InstantEffect {
 public:
  Clipping()
      : InstantEffect({.name = "clipping",
                       .title = "torque channel that clips at a limit",
                       .equation = "recorded torque + c (clamp(tau_motor, -M, L) - tau_motor)",
                       .source = "definition of saturation",
                       .separated_by = "a gentler motion, and a log of the saturation flag",
                       .parameters = {effect_at_upper({"clipping", "1", "1", {0.0}, {1.0}}),
                                      limit("clipping_limit", RelativeTo::torque_highest),
                                      limit("clipping_limit_negative", RelativeTo::torque_lowest)},
                       .families = {EffectFamily::measurement, EffectFamily::load},
                       .signature = {SignatureAxis::load},
                       .parity = Parity::neither,
                       .acts_on = ActsOn::recorded_torque,
                       .needs_baseline = true,
                       .is_of_extremes = true}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const&,
                EffectColumns out) const override {
    out.col(0) = at.motor_torque.max(-shape[1]).min(shape[0]) - at.motor_torque;
  }
};

}  // namespace

Effect const& clipping() {
  static Clipping const effect;
  return effect;
}

}  // namespace torquescope::effects
