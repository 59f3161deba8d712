// An encoder disc off its centre: the angle is read with one wave per turn.
//
// Equation   q_read = q + e(q), e = e_s sin(q) + e_c cos(q)
//            columns: its image in the torque of a model evaluated at q_read, to first order in e:
//            tau = -(g'(q) e + Fv e' dq + J (e' ddq + e'' dq^2)), g the gravity of the baseline
// Simulation runner(): what is added to the position [rad]
// Parameters encoder_eccentricity_sin e_s, encoder_eccentricity_cos e_c [rad], either sign; an angle's encoder only
// Signature  order 1, growing with the square of the speed
// Confused   transmission_error and gravity; cogging does not grow with the speed
// Source     first order of the reading error; PHYSICS.md S3

#include <cmath>

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class ReadingError final : public EffectRunner {
 public:
  ReadingError(double sine, double cosine) : sine_(sine), cosine_(cosine) {}
  void advance(JointState const&, double) override {}
  double torque(JointState const& state) const override {
    return sine_ * std::sin(state.q) + cosine_ * std::cos(state.q);
  }

 private:
  double sine_, cosine_;
};

class EncoderEccentricity final : public InstantEffect {
 public:
  EncoderEccentricity()
      : InstantEffect(
            {.name = "encoder_eccentricity",
             .title = "encoder disc off its centre",
             .equation = "recorded position + e_s sin(q) + e_c cos(q)",
             .source = "first order of the reading error",
             .separated_by = "full turns at two constant speeds: the reading error grows with the square of the speed",
             .parameters = {{"encoder_eccentricity_sin", "rad", "", {-0.01}, {0.01}},
                            {"encoder_eccentricity_cos", "rad", "", {-0.01}, {0.01}}},
             .families = {EffectFamily::order_locked, EffectFamily::measurement},
             .signature = {SignatureAxis::order, SignatureAxis::velocity},
             .parity = Parity::neither,
             .acts_on = ActsOn::recorded_position,
             .needs_baseline = true}) {}

  std::unique_ptr<EffectRunner> runner(std::span<double const> parameters, JointScales const&) const override {
    return std::make_unique<ReadingError>(parameters[0], parameters[1]);
  }

 private:
  void law(JointStates const& at, std::span<double const>, JointScales const& scales, LawColumns out) const override {
    Scratch c(at.size()), s(at.size());
    cosine_sine(1.0, at.q, c, s);
    Scratch const gravity_slope = scales.gravity_sin * c - scales.gravity_cos * s;
    Scratch const per_slope = scales.viscous * at.dq + scales.inertia * at.ddq;
    Scratch const per_curvature = scales.inertia * at.dq.square();
    out.col(0) = -(gravity_slope * s + per_slope * c - per_curvature * s);
    out.col(1) = -(gravity_slope * c - per_slope * s - per_curvature * c);
  }
};

}  // namespace

Effect const& encoder_eccentricity() {
  static EncoderEccentricity const effect;
  return effect;
}

}  // namespace torquescope::effects
