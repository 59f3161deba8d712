// Current loop that follows its command late, while the command is what was recorded.
//
// Equation   command = true + tau_e d true/dt
//            columns: the derivative of the baseline's torque (central differences), exact in tau_e
// Simulation runner(): the part of the command that has not arrived, command - true, with command = state.motor_torque
//            and d true/dt = (command - true) / tau_e, exact for a command that is linear over a step
// Parameters actuator_lag tau_e >= 0 [s]
// Signature  acceleration: follows the jerk; the gain falls at high frequency
// Confused   delay (with the other sign), joint_elasticity
// Source     definition of a first-order current loop

#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/effects/effect.hpp"
#include "engine/effects/remembered_steps.hpp"

namespace torquescope::effects {
namespace {

class LaggingMotor final : public EffectRunner {
 public:
  explicit LaggingMotor(double lag_s) : lag_s_(lag_s) {}

  void advance(JointState const& state, double step_s) override {
    if (!has_started_ || !(lag_s_ > 0.0)) {
      true_ = state.motor_torque;
    } else {
      double const slope = (state.motor_torque - command_) / step_s;
      double const decay = decay_.of(step_s, [this](double of_s) { return std::exp(-of_s / lag_s_); });
      true_ = state.motor_torque - lag_s_ * slope + (true_ - command_ + lag_s_ * slope) * decay;
    }
    command_ = state.motor_torque;
    has_started_ = true;
  }

  double torque(JointState const& state) const override { return state.motor_torque - true_; }

 private:
  double lag_s_;
  RememberedSteps<double> decay_{};
  double command_ = 0.0, true_ = 0.0;
  bool has_started_ = false;
};

class ActuatorLag final : public Effect {
 public:
  ActuatorLag()
      : Effect({.name = "actuator_lag",
                .title = "current loop that follows its command late",
                .equation = "tau_e d tau_motor/dt",
                .source = "definition of a first-order current loop",
                .separated_by = "a wideband multisine up to the bandwidth of the current loop",
                .parameters = {{"actuator_lag", "s", "s", {0.0}, {20.0, RelativeTo::sample_period}}},
                .families = {EffectFamily::acceleration, EffectFamily::reversal},
                .signature = {SignatureAxis::acceleration, SignatureAxis::frequency},
                .parity = Parity::neither,
                .needs_baseline = true}) {}
  bool has_memory() const override { return true; }

  void columns(EffectInput const& input, std::span<double const> shape,
               Eigen::Ref<Eigen::MatrixXd> out) const override {
    auto const n = input.size();
    TORQUESCOPE_EXPECT(shape.empty() && out.rows() == n && out.cols() == 1);
    TORQUESCOPE_EXPECT(input.model_torque.size() == static_cast<std::size_t>(n));
    auto const& torque = input.model_torque;
    auto const& time_s = input.motion.time_s;
    for (Eigen::Index i = 0; i < n; ++i) {
      Eigen::Index const before = i > 0 ? i - 1 : i, after = i + 1 < n ? i + 1 : i;
      out(i, 0) = after == before
                      ? 0.0
                      : (torque[static_cast<std::size_t>(after)] - torque[static_cast<std::size_t>(before)]) /
                            (time_s[after] - time_s[before]);
    }
  }

  std::unique_ptr<EffectRunner> runner(std::span<double const> parameters, JointScales const&) const override {
    TORQUESCOPE_EXPECT(parameters.size() == 1);
    return std::make_unique<LaggingMotor>(parameters[0]);
  }
};

}  // namespace

Effect const& actuator_lag() {
  static ActuatorLag const effect;
  return effect;
}

}  // namespace torquescope::effects
