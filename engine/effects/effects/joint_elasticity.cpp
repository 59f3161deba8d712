// Flexible transmission: part of the inertia hangs on the motor by a spring and a damper.
//
// Equation   tau = J_l y'', y'' + 2 zeta w y' + w^2 y = -ddq: y is the load relative to the motor, w = 2 pi f;
//            the rigid part J_l ddq is in the baseline's inertia
// Memory     y and y', exact for an acceleration that runs straight between two samples
// Why        an operator, not jerk and snap: a series of derivatives fails once the resonance lies in the band
// Parameters load_inertia J_l >= 0 [kg m2; kg], up to the whole inertia; elasticity_frequency f [Hz]: of the load with the
//            motor held (antiresonance of the joint); elasticity_damping zeta [1]
// Signature  frequency: a narrow band fixed in time, rung by jerk
// Confused   delay, actuator_lag far below f
// Source     Spong 1987; Wernholt 2007; LESSONS.md item 10

#include <cmath>
#include <numbers>

#include "engine/effects/memory_effect.hpp"

namespace torquescope::effects {
namespace {

class LoadOnSpring final : public EffectMemory {
 public:
  LoadOnSpring(double frequency_hz, double damping)
      : omega_(2.0 * std::numbers::pi * frequency_hz),
        decay_(damping * omega_),
        ringing_(omega_ * std::sqrt(1.0 - damping * damping)) {}

  // as if the acceleration had been the same for long
  void start(JointState const& state) override {
    ddq_ = state.ddq;
    y_ = -ddq_ / (omega_ * omega_);
    dy_ = 0.0;
  }

  void advance(JointState const& state, double step_s) override {
    if (step_s != step_s_) remember_step(step_s);
    double const jerk = (state.ddq - ddq_) / step_s;
    double const square = omega_ * omega_;

    // what remains after the motion that follows a straight acceleration rings freely
    double const follow = -ddq_ / square + 2.0 * decay_ * jerk / (square * square);
    double const dfollow = -jerk / square;
    double const free = y_ - follow, dfree = dy_ - dfollow;
    double const quadrature = (dfree + decay_ * free) / ringing_;
    double const rung = faded_ * (free * cosine_ + quadrature * sine_);
    double const drung =
        faded_ * ((quadrature * ringing_ - decay_ * free) * cosine_ - (free * ringing_ + decay_ * quadrature) * sine_);

    y_ = rung + follow + dfollow * step_s;
    dy_ = drung + dfollow;
    ddq_ = state.ddq;
  }

  void row(JointState const& state, std::span<double> out) const override {
    out[0] = -(2.0 * decay_ * dy_ + omega_ * omega_ * y_) - state.ddq;
  }

 private:
  void remember_step(double step_s) {
    step_s_ = step_s;
    faded_ = std::exp(-decay_ * step_s);
    cosine_ = std::cos(ringing_ * step_s);
    sine_ = std::sin(ringing_ * step_s);
  }

  double omega_, decay_, ringing_;
  double step_s_ = 0.0, faded_ = 1.0, cosine_ = 1.0, sine_ = 0.0;
  double ddq_ = 0.0, y_ = 0.0, dy_ = 0.0;
};

class JointElasticity final : public MemoryEffect {
 public:
  JointElasticity()
      : MemoryEffect(
            {.name = "joint_elasticity",
             .title = "flexible transmission between motor and load",
             .equation = "J_l y'', y'' + 2 zeta w y' + w^2 y = -ddq, w = 2 pi f",
             .source = "Spong 1987; Wernholt 2007",
             .separated_by = "a multisine or chirp up to twice the resonance",
             .parameters = {{"load_inertia", "kg m2", "kg", {0.0}, {1.0, RelativeTo::inertia}},
                            shape_parameter("elasticity_frequency", "Hz", "Hz", {0.05, RelativeTo::cutoff_frequency},
                                            {1.5, RelativeTo::cutoff_frequency}, Spacing::logarithmic),
                            shape_parameter("elasticity_damping", "1", "1", {0.005}, {0.2}, Spacing::logarithmic)},
             .families = {EffectFamily::acceleration},
             .signature = {SignatureAxis::frequency, SignatureAxis::acceleration},
             .parity = Parity::even}) {}

 private:
  std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const&) const override {
    return std::make_unique<LoadOnSpring>(shape[0], shape[1]);
  }
};

}  // namespace

Effect const& joint_elasticity() {
  static JointElasticity const effect;
  return effect;
}

}  // namespace torquescope::effects
