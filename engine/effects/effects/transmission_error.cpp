// Kinematic error of a gear or harmonic drive: the load does not turn exactly as the motor does.
//
// Equation   q_load = q + h(q), h = A cos(N q) + B sin(N q); to first order in h
//            tau = h' (tau_load + J ddq + 2 Fv dq) + J h'' dq^2 + g' h, h' = dh/dq; g the gravity of the baseline;
//            J, Fv and g are taken as on the load side, Coulomb friction as on the motor's
// Parameters transmission_error_cos A, transmission_error_sin B [rad; m], either sign;
//            transmission_error_order N [1/rad; 1/m] (2 per turn of a harmonic drive, 1 of a gear or screw)
// Signature  order: fixed in the angle, its size grows with the square of the speed
// Confused   cogging at low speed, encoder_eccentricity
// Source     Tuttle, Seering 1996

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class TransmissionError final : public InstantEffect {
 public:
  TransmissionError()
      : InstantEffect(
            {.name = "transmission_error",
             .title = "kinematic error of the transmission",
             .equation = "h' (tau_load + J ddq + 2 Fv dq) + J h'' dq^2 + g' h, h = A cos(N q) + B sin(N q)",
             .source = "Tuttle, Seering 1996",
             .separated_by = "constant speed at two speeds in both directions, with an encoder on the output",
             .parameters = {{"transmission_error_cos",
                             "rad",
                             "m",
                             {-0.01, RelativeTo::position_range},
                             {0.01, RelativeTo::position_range}},
                            {"transmission_error_sin",
                             "rad",
                             "m",
                             {-0.01, RelativeTo::position_range},
                             {0.01, RelativeTo::position_range}},
                            shape_parameter("transmission_error_order", "1/rad", "1/m", {2.0, RelativeTo::lowest_order},
                                            {1.0, RelativeTo::highest_order}, Spacing::linear)},
             .families = {EffectFamily::order_locked},
             .signature = {SignatureAxis::order, SignatureAxis::velocity},
             .parity = Parity::neither,
             .needs_baseline = true}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const& scales,
                EffectColumns out) const override {
    double const n = shape[0];
    Scratch c(at.size()), s(at.size()), once_c(at.size()), once_s(at.size());
    cosine_sine(n, at.q, c, s);
    cosine_sine(1.0, at.q, once_c, once_s);
    Scratch const per_slope = at.load_torque + scales.inertia * at.ddq + 2.0 * scales.viscous * at.dq;
    Scratch const per_error = scales.gravity_sin * once_c - scales.gravity_cos * once_s;
    Scratch const per_curvature = scales.inertia * at.dq.square();
    out.col(0) = c * per_error - n * s * per_slope - n * n * c * per_curvature;
    out.col(1) = s * per_error + n * c * per_slope - n * n * s * per_curvature;
  }
};

}  // namespace

Effect const& transmission_error() {
  static TransmissionError const effect;
  return effect;
}

}  // namespace torquescope::effects
