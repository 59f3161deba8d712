// Cogging: the magnets' preferred angles, whatever the current.
//
// Equation   tau = A cos(N q) + B sin(N q)
// Parameters cogging_cos A, cogging_sin B [N m; N], either sign; cogging_order N [1/rad; 1/m]: waves per turn
// Signature  order: fixed in the angle, its frequency follows the speed, its size neither speed nor load
// Confused   torque_ripple, transmission_error, encoder_eccentricity; periodic_disturbance at a single speed
// Bounds     of a motor that turns freely cogging is all of the torque: the peak of a sine is more than its rms
// Source     Islam, Mir, Sebastian 2004; usual size 1 to 5 % of rated torque (MuJoCo documentation)

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class Cogging final : public InstantEffect {
 public:
  Cogging()
      : InstantEffect(
            {.name = "cogging",
             .title = "cogging torque of the motor, fixed in the angle",
             .equation = "A cos(N q) + B sin(N q)",
             .source = "Islam, Mir, Sebastian 2004",
             .separated_by = "constant speed at two or more speeds in both directions, with and without load",
             .parameters = {{"cogging_cos", "N m", "N", {-3.0, RelativeTo::torque}, {3.0, RelativeTo::torque}},
                            {"cogging_sin", "N m", "N", {-3.0, RelativeTo::torque}, {3.0, RelativeTo::torque}},
                            shape_parameter("cogging_order", "1/rad", "1/m", {2.0, RelativeTo::lowest_order},
                                            {1.0, RelativeTo::highest_order}, Spacing::linear)},
             .families = {EffectFamily::order_locked},
             .signature = {SignatureAxis::order, SignatureAxis::position},
             .parity = Parity::even,
             .code = "cogging_cos * cos(cogging_order * q) + cogging_sin * sin(cogging_order * q)"}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const&,
                EffectColumns out) const override {
    cosine_sine(shape[0], at.q, out.col(0), out.col(1));
  }

  void evaluate_each(JointStates const& at, ParametersOfEach const& shapes, JointScales const&,
                     EffectColumns out) const override {
    cosine_sine(NumberOfEach(shapes.col(0)), at.q, out.col(0), out.col(1));
  }
};

}  // namespace

Effect const& cogging() {
  static Cogging const effect;
  return effect;
}

}  // namespace torquescope::effects
