// An encoder disc off its centre: the angle is read with one wave per turn, and a second one where the disc wobbles, is
// oval or is a magnet.
//
// Equation   q_read = q + e(q), e = e_s sin(q) + e_c cos(q) + e_s2 sin(2 q) + e_c2 cos(2 q)
//            columns: its image in the torque of a model evaluated at q_read, to first order in e:
//            tau = -(g'(q) e + Fv e' dq + J (e' ddq + e'' dq^2)), g the gravity of the baseline
// Simulation runner(): what is added to the position [rad]
// Parameters encoder_eccentricity_sin e_s, _cos e_c, _sin_2 e_s2, _cos_2 e_c2 [rad], either sign; an angle's encoder
//            only. Without the second wave, what is left of it passes for a gear error
// Signature  orders 1 and 2, growing with the square of the speed
// Confused   transmission_error and gravity; cogging does not grow with the speed
// Source     first two orders of the reading error, by definition

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

constexpr std::size_t n_waves = 2;

class ReadingError final : public EffectRunner {
 public:
  explicit ReadingError(std::span<double const> waves) { std::copy(waves.begin(), waves.end(), waves_.begin()); }
  void advance(JointState const&, double) override {}
  double torque(JointState const& state) const override {
    double error = 0.0;
    for (std::size_t k = 0; k < n_waves; ++k) {
      double const angle = static_cast<double>(k + 1) * state.q;
      error += waves_[2 * k] * std::sin(angle) + waves_[2 * k + 1] * std::cos(angle);
    }
    return error;
  }

 private:
  std::array<double, 2 * n_waves> waves_{};
};

class EncoderEccentricity final : public InstantEffect {
 public:
  EncoderEccentricity()
      : InstantEffect(
            {.name = "encoder_eccentricity",
             .title = "encoder disc off its centre",
             .equation = "recorded position + e_s sin(q) + e_c cos(q) + e_s2 sin(2 q) + e_c2 cos(2 q)",
             .source = "first two orders of the reading error",
             .separated_by = "full turns at two constant speeds: the reading error grows with the square of the speed",
             .parameters = {{"encoder_eccentricity_sin", "rad", "", {-0.01}, {0.01}},
                            {"encoder_eccentricity_cos", "rad", "", {-0.01}, {0.01}},
                            {"encoder_eccentricity_sin_2", "rad", "", {-0.01}, {0.01}},
                            {"encoder_eccentricity_cos_2", "rad", "", {-0.01}, {0.01}}},
             .families = {EffectFamily::order_locked, EffectFamily::measurement},
             .signature = {SignatureAxis::order, SignatureAxis::velocity},
             .parity = Parity::neither,
             .acts_on = ActsOn::recorded_position,
             .needs_baseline = true}) {}

  std::unique_ptr<EffectRunner> runner(std::span<double const> parameters, JointScales const&) const override {
    return std::make_unique<ReadingError>(parameters);
  }

 private:
  void evaluate(JointStates const& at, std::span<double const>, JointScales const& scales,
                EffectColumns out) const override {
    Scratch c(at.size()), s(at.size());
    cosine_sine(1.0, at.q, c, s);
    Scratch const gravity_slope = scales.gravity_sin * c - scales.gravity_cos * s;
    Scratch const per_slope = scales.viscous * at.dq + scales.inertia * at.ddq;
    Scratch const per_curvature = scales.inertia * at.dq.square();
    for (std::size_t k = 0; k < n_waves; ++k) {
      double const order = static_cast<double>(k + 1);
      if (k > 0) cosine_sine(order, at.q, c, s);
      auto const sine = static_cast<Eigen::Index>(2 * k), cosine = sine + 1;
      out.col(sine) = -(gravity_slope * s + order * (per_slope * c - order * per_curvature * s));
      out.col(cosine) = -(gravity_slope * c - order * (per_slope * s + order * per_curvature * c));
    }
  }
};

}  // namespace

Effect const& encoder_eccentricity() {
  static EncoderEccentricity const effect;
  return effect;
}

}  // namespace torquescope::effects
