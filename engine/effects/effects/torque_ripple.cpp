// Torque ripple: a torque constant that waves with the angle.
//
// Equation   tau = tau_motor (r_c cos(N q) + r_s sin(N q))
// Parameters torque_ripple_cos r_c, torque_ripple_sin r_s [1], either sign; torque_ripple_order N [1/rad; 1/m]
// Signature  order: fixed in the angle, in proportion to the torque
// Confused   cogging; two levels of load tell them apart
// Source     Islam, Mir, Sebastian 2004; Holtz, Springob 1996

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class TorqueRipple final : public InstantEffect {
 public:
  TorqueRipple()
      : InstantEffect(
            {.name = "torque_ripple",
             .title = "torque constant that waves with the angle",
             .equation = "tau_motor (r_c cos(N q) + r_s sin(N q))",
             .source = "Holtz, Springob 1996",
             .separated_by = "constant speed with two levels of load",
             .parameters = {{"torque_ripple_cos", "1", "1", {-0.3}, {0.3}},
                            {"torque_ripple_sin", "1", "1", {-0.3}, {0.3}},
                            shape_parameter("torque_ripple_order", "1/rad", "1/m", {2.0, RelativeTo::lowest_order},
                                            {1.0, RelativeTo::highest_order}, Spacing::linear)},
             .families = {EffectFamily::order_locked, EffectFamily::load},
             .signature = {SignatureAxis::order, SignatureAxis::load},
             .parity = Parity::neither,
             .needs_baseline = true}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const&,
                EffectColumns out) const override {
    cosine_sine(shape[0], at.q, out.col(0), out.col(1));
    out.col(0) *= at.motor_torque;
    out.col(1) *= at.motor_torque;
  }
};

}  // namespace

Effect const& torque_ripple() {
  static TorqueRipple const effect;
  return effect;
}

}  // namespace torquescope::effects
