// Saturating motor: the torque per ampere falls at high current, so the recorded torque (current times a constant) is
// larger than the true one. A constant error of the scale cannot be seen: it scales every parameter alike.
//
// Equation   tau = beta tau_motor^3
// Parameters torque_constant beta >= 0 [1/(N m)2; 1/N2]
// Signature  load: at the peaks of torque, whatever the motion
// Confused   load_dependent_friction, clipping
// Source     Gautier, Briot 2014 (drive gains); PHYSICS.md A3

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class TorqueConstant final : public InstantEffect {
 public:
  TorqueConstant()
      : InstantEffect(
            {.name = "torque_constant",
             .title = "torque constant that falls at high current",
             .equation = "beta tau_motor^3",
             .source = "Gautier, Briot 2014",
             .separated_by = "a known payload",
             .parameters = {{"torque_constant", "1/(N m)2", "1/N2", {0.0}, {0.05, RelativeTo::torque_inverse2}}},
             .families = {EffectFamily::load},
             .signature = {SignatureAxis::load},
             .parity = Parity::neither,
             .needs_baseline = true}) {}

 private:
  void law(JointStates const& at, std::span<double const>, JointScales const&, LawColumns out) const override {
    out.col(0) = at.motor_torque * at.motor_torque * at.motor_torque;
  }
};

}  // namespace

Effect const& torque_constant() {
  static TorqueConstant const effect;
  return effect;
}

}  // namespace torquescope::effects
