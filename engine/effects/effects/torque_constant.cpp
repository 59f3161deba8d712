// Saturating motor: the torque per ampere falls at high current, so the recorded torque (current times a constant) is
// larger than the true one. A constant error of the scale cannot be seen: it scales every parameter alike.
//
// Equation   tau = beta tau_motor^3; tau_motor: what the motor really gives, the recorded torque less tau
// Why        a cubic of the recorded torque would turn round at 1 / sqrt(3 beta), and its simulation diverges there
// Simulation given the recorded torque u: solves tau_motor + beta tau_motor^3 = u
// Parameters torque_constant beta >= 0 [1/(N m)2; 1/N2]
// Signature  load: at the peaks of torque, whatever the motion
// Confused   load_dependent_friction, clipping
// Source     Gautier, Briot 2014, Global identification of joint drive gains, doi:10.1115/1.4027506

#include <cmath>

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
             .parameters = {{"torque_constant", "1/(N m)2", "1/N2", {0.0}, {0.2, RelativeTo::torque_inverse2}}},
             .families = {EffectFamily::load},
             .signature = {SignatureAxis::load},
             .parity = Parity::neither,
             .needs_baseline = true}) {}

  void torques(JointStates const& at, std::span<double const> parameters, JointScales const&,
               std::span<double> out) const override {
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = missing(at.motor_torque[static_cast<Eigen::Index>(i)], parameters[0]);
  }

  void torques_of_each(JointStates const& at, ParametersOfEach const& parameters, JointScales const&,
                       std::span<double> out) const override {
    for (Eigen::Index i = 0; i < at.size(); ++i)
      out[static_cast<std::size_t>(i)] = missing(at.motor_torque[i], parameters(i, 0));
  }

 private:
  static double missing(double recorded, double beta) { return recorded - given(recorded, beta); }

  // Newton from above: the cubic is convex there, so that it never steps past the root
  static double given(double recorded, double beta) {
    constexpr int enough = 6;
    double const all_cubic = beta > 0.0 ? std::cbrt(recorded / beta) : recorded;
    double torque = std::abs(all_cubic) < std::abs(recorded) ? all_cubic : recorded;
    for (int i = 0; i < enough; ++i) {
      double const square = beta * torque * torque;
      torque -= (torque * (1.0 + square) - recorded) / (1.0 + 3.0 * square);
    }
    return torque;
  }

  void evaluate(JointStates const& at, std::span<double const>, JointScales const&, EffectColumns out) const override {
    out.col(0) = at.motor_torque * at.motor_torque * at.motor_torque;
  }
};

}  // namespace

Effect const& torque_constant() {
  static TorqueConstant const effect;
  return effect;
}

}  // namespace torquescope::effects
