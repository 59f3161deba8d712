// A payload picked up or dropped while recording.
//
// Equation   tau = (dJ ddq + dg_s sin(q) + dg_c cos(q)) [t >= t_c]; on a slide (dm ddq + dw) [t >= t_c]
// Parameters payload_inertia dJ [kg m2; kg], not below minus the baseline's; payload_gravity_sin [N m; none on a
// slide],
//            payload_gravity_cos [N m; N: the weight along the slide], either sign; payload_time t_c [s]
// Signature  time: a step in acceleration and position effects
// Confused   sensor_drift, friction_drift
// Source     Gaz, De Luca 2017 (payload parameters)

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
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const& scales,
                EffectColumns out) const override {
    auto const carried = is_after(at.time_s, shape[0]);
    out.col(0) = carried * at.ddq;
    if (scales.joint == JointKind::prismatic) {
      out.col(1) = 0.0;
      out.col(2) = carried;
      return;
    }
    cosine_sine(1.0, at.q, out.col(2), out.col(1));
    out.col(1) *= carried;
    out.col(2) *= carried;
  }
};

}  // namespace

Effect const& payload_change() {
  static PayloadChange const effect;
  return effect;
}

}  // namespace torquescope::effects
