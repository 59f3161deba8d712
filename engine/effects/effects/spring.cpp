// Spring or counterbalance across the joint.
//
// Equation   tau = k q + k h (q - q_0)^3; the torque at q = 0 is the baseline's offset. As a term of a model: k q
// Parameters spring k [N m/rad; N/m]: stiffness at rest; negative: a counterbalance past its dead centre;
//            spring_hardening h >= 0 [1/rad2; 1/m2]: at x from rest it is 1 + 3 h x^2 times as stiff, at most seven
//            times at the end of the travel (stiffer is an end_stop); spring_rest q_0 [rad; m]: on the travel
// Softening  is the sine of `gravity`; coils and rubber harden
// Signature  position: a line, straight or with a cubic, even in the velocity
// Confused   gravity while the travel is below 60 degrees; cable, which has a loop
// Source     Khalil, Dombre 2002, Modeling, Identification and Control of Robots; hardening: Duffing 1918; Nayfeh, Mook
//            1979, Nonlinear Oscillations, section 1.1

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class Spring final : public InstantEffect {
 public:
  Spring()
      : InstantEffect(
            {.name = "spring",
             .title = "spring or counterbalance across the joint",
             .equation = "k q + k h (q - q_0)^3",
             .source = "Khalil, Dombre 2002, Modeling, Identification and Control of Robots; Duffing 1918 (hardening)",
             .separated_by = "slow motion over more than 120 degrees, or two orientations of the base",
             .parameters = {{"spring",
                             "N m/rad",
                             "N/m",
                             {-5.0, RelativeTo::torque_per_range},
                             {5.0, RelativeTo::torque_per_range}},
                            shape_parameter("spring_hardening", "1/rad2", "1/m2", {0.0},
                                            {2.0, RelativeTo::range_inverse2}, Spacing::linear),
                            shape_parameter("spring_rest", "rad", "m", {-0.5, RelativeTo::position},
                                            {0.5, RelativeTo::position}, Spacing::linear)},
             .families = {EffectFamily::static_position},
             .signature = {SignatureAxis::position},
             .parity = Parity::even,
             .is_level_free = true,
             .plain_equation = "k q",
             .code = "spring * (q + spring_hardening * pow(q - spring_rest, 3))",
             .plain_code = "spring * q"}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const&,
                EffectColumns out) const override {
    if (shape.empty())
      out.col(0) = at.q;
    else
      harden(at, shape[0], shape[1], out);
  }

  void evaluate_each(JointStates const& at, ParametersOfEach const& shapes, JointScales const&,
                     EffectColumns out) const override {
    harden(at, NumberOfEach(shapes.col(0)), NumberOfEach(shapes.col(1)), out);
  }

  template <typename Number>
  static void harden(JointStates const& at, Number const& hardening, Number const& rest, EffectColumns out) {
    Scratch const x = at.q - rest;
    out.col(0) = at.q + hardening * x * x.square();
  }
};

}  // namespace

Effect const& spring() {
  static Spring const effect;
  return effect;
}

}  // namespace torquescope::effects
