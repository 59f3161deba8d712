// Flexible transmission: part of the inertia hangs on the motor by a spring and a damper.
//
// Equation   tau = J_l y'', y'' + 2 zeta w y' + w^2 y (1 + c (y / y_0)^2) = -ddq: y is the load relative to the motor, w = 2 pi f;
//            y_0 = a / w^2 is the wind-up that the acceleration a = torque rms / inertia makes of a straight spring;
//            the rigid part J_l ddq is in the baseline's inertia
// Memory     y and y', for c = 0 exact for an acceleration that runs straight between two samples; what stiffens is a kick before
//            and after each step (Strang), of second order
// Stiffening gears of thin steel are softest when they are not loaded; without c a gap would be the better fit, and its name wrong.
//            Its bounds are far apart: a soft spring that stiffens much passes for a stiffer one that stiffens little, and each cycle
//            that both ring alike is a maximum of its own
// Why        an operator, not jerk and snap: a series of derivatives fails once the resonance lies in the band
// Parameters load_inertia J_l >= 0 [kg m2; kg], up to four times the fitted inertia, in which a load that stays behind has little part; elasticity_frequency f [Hz]: of the load with the
//            motor held (antiresonance of the joint), unloaded; elasticity_damping zeta [1]; elasticity_hardening c [1]: a load that rings winds the
//            spring up twenty times as far as y_0, so that no number but 0 is none
// Signature  frequency: a narrow band fixed in time, rung by jerk
// Confused   delay, actuator_lag far below f
// Source     Spong 1987; Wernholt 2007; stiffening: Tuttle, Seering 1996; LESSONS.md item 10; kicks: Strang 1968

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/effects/memory_effect.hpp"
#include "engine/effects/remembered_steps.hpp"

namespace torquescope::effects {
namespace {

class LoadOnSpring {
 public:
  // acceleration: a; 0: the spring is straight
  LoadOnSpring(double frequency_hz, double damping, double hardening, double acceleration)
      : omega_(2.0 * std::numbers::pi * frequency_hz),
        decay_(damping * omega_),
        ringing_(omega_ * std::sqrt(1.0 - damping * damping)),
        per_square_(acceleration > 0.0 ? hardening * std::pow(omega_ * omega_ / acceleration, 2) : 0.0) {}

  // as if the acceleration had been the same for long
  void start(JointState const& state) {
    ddq_ = state.ddq;
    y_ = -ddq_ / (omega_ * omega_);
    dy_ = 0.0;
  }

  void advance(JointState const& state, double step_s) {
    if (step_s != whole_step_s_) {
      whole_step_s_ = step_s;
      swing_ = steps_.of(step_s, [this](double whole_s) { return swing_in(whole_s); });
    }
    double const jerk = (state.ddq - ddq_) / step_s;
    for (int part = 0; part < swing_.parts; ++part) {
      dy_ -= 0.5 * swing_.step_s * stiffened();
      coast(jerk);
      dy_ -= 0.5 * swing_.step_s * stiffened();
    }
    ddq_ = state.ddq;
  }

  std::array<double, 1> row(JointState const& state) const {
    return {-(2.0 * decay_ * dy_ + omega_ * omega_ * y_ + stiffened()) - state.ddq};
  }

 private:
  // a straight spring in one part of a step
  struct Swing {
    int parts = 1;
    double step_s = 0.0, faded = 1.0, cosine = 1.0, sine = 0.0;
  };

  static constexpr double most_stiffening = 25.0;  // times as stiff as unloaded: no gear goes further

  // acceleration of the load by what the spring has more than a straight one
  double stiffened() const { return omega_ * omega_ * y_ * std::min(per_square_ * y_ * y_, most_stiffening); }

  // one part of the step on a straight spring
  void coast(double jerk) {
    double const square = omega_ * omega_;

    // what remains after the motion that follows a straight acceleration rings freely
    double const follow = -ddq_ / square + 2.0 * decay_ * jerk / (square * square);
    double const dfollow = -jerk / square;
    double const free = y_ - follow, dfree = dy_ - dfollow;
    double const quadrature = (dfree + decay_ * free) / ringing_;
    auto const& [parts, step_s, faded, cosine, sine] = swing_;
    double const rung = faded * (free * cosine + quadrature * sine);
    double const drung =
        faded * ((quadrature * ringing_ - decay_ * free) * cosine - (free * ringing_ + decay_ * quadrature) * sine);

    y_ = rung + follow + dfollow * step_s;
    dy_ = drung + dfollow;
    ddq_ += jerk * step_s;
  }

  Swing swing_in(double whole_s) const {
    // kicks are stable up to 2 rad of the stiffest spring's swing
    double const stiffest = per_square_ > 0.0 ? omega_ * std::sqrt(most_stiffening) * whole_s : 0.0;
    int const parts = std::max(1, static_cast<int>(std::ceil(stiffest)));
    double const step_s = whole_s / parts;
    return {parts, step_s, std::exp(-decay_ * step_s), std::cos(ringing_ * step_s), std::sin(ringing_ * step_s)};
  }

  double omega_, decay_, ringing_, per_square_;
  RememberedSteps<Swing> steps_{};
  double whole_step_s_ = 0.0;
  Swing swing_{};  // of that step
  double ddq_ = 0.0, y_ = 0.0, dy_ = 0.0;
};

class JointElasticity final : public MemoryEffect {
 public:
  JointElasticity()
      : MemoryEffect(
            {.name = "joint_elasticity",
             .title = "flexible transmission between motor and load",
             .equation = "J_l y'', y'' + 2 zeta w y' + w^2 y (1 + c (y / y0)^2) = -ddq, w = 2 pi f",
             .source = "Spong 1987; Wernholt 2007",
             .separated_by = "a multisine or chirp up to twice the resonance",
             .parameters = {{"load_inertia", "kg m2", "kg", {0.0}, {4.0, RelativeTo::inertia}},
                            resonance(shape_parameter("elasticity_frequency", "Hz", "Hz",
                                                      {0.05, RelativeTo::cutoff_frequency},
                                                      {1.5, RelativeTo::cutoff_frequency}, Spacing::logarithmic)),
                            shape_parameter("elasticity_damping", "1", "1", {0.005}, {0.2}, Spacing::logarithmic),
                            shape_parameter("elasticity_hardening", "1", "1", {0.0}, {8.0}, Spacing::cubic)},
             .families = {EffectFamily::acceleration},
             .signature = {SignatureAxis::frequency, SignatureAxis::acceleration},
             .parity = Parity::even,
             .has_inertia = true}) {}

 private:
  std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const& scales,
                                       std::size_t lanes) const override {
    double const acceleration = scales.inertia > 0.0 ? scales.torque_rms / scales.inertia : 0.0;
    return memory_of(LoadOnSpring(shape[0], shape[1], shape[2], acceleration), lanes);
  }
};

}  // namespace

Effect const& joint_elasticity() {
  static JointElasticity const effect;
  return effect;
}

}  // namespace torquescope::effects
