// A payload picked up or dropped while recording.
//
// Equation   tau = (dJ ddq + dg_s sin(q) + dg_c cos(q)) [t >= t_c]; on a slide (dm ddq + dw) [t >= t_c]
// Parameters payload_inertia dJ [kg m2; kg], not below minus the baseline's; payload_gravity_sin [N m; none on a slide],
//            payload_gravity_cos [N m; N: the weight along the slide], either sign; payload_time t_c [s]
// Signature  time: a step in acceleration and position laws
// Confused   sensor_drift, friction_drift
// Source     Gaz, De Luca 2017 (payload parameters)

#include <cmath>

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class PayloadChange final : public InstantEffect {
 public:
  PayloadChange()
      : InstantEffect(
            {.name = "payload_change",
             .title = "payload picked up or dropped",
             .equation = "(dJ ddq + dg_s sin(q) + dg_c cos(q)) [t >= t_c]",
             .source = "Gaz, De Luca 2017",
             .separated_by = "a rest before and after the change",
             .parameters =
                 {{"payload_inertia", "kg m2", "kg", {-1.0, RelativeTo::inertia}, {10.0, RelativeTo::inertia}},
                  {"payload_gravity_sin", "N m", ""},
                  {"payload_gravity_cos", "N m", "N"},
                  shape_parameter("payload_time", "s", "s", {0.05, RelativeTo::instant}, {0.95, RelativeTo::instant},
                                  Spacing::linear)},
             .families = {EffectFamily::time, EffectFamily::outside},
             .signature = {SignatureAxis::time, SignatureAxis::acceleration, SignatureAxis::position},
             .parity = Parity::even}) {}

 private:
  void row(JointState const& state, std::span<double const> shape, JointScales const& scales,
           std::span<double> out) const override {
    bool const is_angle = scales.joint == JointKind::revolute;
    double const carried = state.time_s >= shape[0] ? 1.0 : 0.0;
    out[0] = carried * state.ddq;
    out[1] = is_angle ? carried * std::sin(state.q) : 0.0;
    out[2] = is_angle ? carried * std::cos(state.q) : carried;
  }
};

}  // namespace

Effect const& payload_change() {
  static PayloadChange const effect;
  return effect;
}

}  // namespace torquescope::effects
