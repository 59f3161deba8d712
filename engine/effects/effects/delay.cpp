// The torque channel lags behind the position channel.
//
// Equation   recorded = true + d (true(t - D) - true(t)) / D; with D = d it is exactly true(t - d), with D -> 0 the
//            first order -d dtau/dt
// Why        for delays below the filter's resolution only d can be seen, and it is linear; for long ones D follows it
// Memory     the torque of the last D
// Parameters delay d [s], negative when the position lags; delay_span D [s]
// Signature  acceleration: follows the jerk, with a spike at each reversal; a phase that grows with the frequency
// Confused   actuator_lag, friction_lag, joint_elasticity, presliding
// Source     definition of a delay; as MuJoCo's system identification toolbox applies it (apply_delay)

#include <array>

#include "engine/effects/lagged_signal.hpp"
#include "engine/effects/memory_effect.hpp"

namespace torquescope::effects {
namespace {

class LateTorque {
 public:
  explicit LateTorque(double span_s) : span_s_(span_s), torque_(span_s) {}
  void start(JointState const& state) { torque_.start(state.time_s, state.motor_torque); }
  void advance(JointState const& state, double) { torque_.push(state.time_s, state.motor_torque); }
  std::array<double, 1> row(JointState const& state) const {
    return {(torque_.lagged() - state.motor_torque) / span_s_};
  }

 private:
  double span_s_;
  LaggedSignal torque_;
};

class Delay final : public MemoryEffect {
 public:
  Delay()
      : MemoryEffect(
            {.name = "delay",
             .title = "torque and position channel out of step",
             .equation = "recorded torque + d (tau_motor(t - D) - tau_motor(t)) / D",
             .source = "MuJoCo sysid, apply_delay",
             .separated_by = "a step of torque recorded on both channels, or a wideband multisine",
             .parameters = {{"delay", "s", "s", {-5.0, RelativeTo::sample_period}, {50.0, RelativeTo::sample_period}},
                            effect_at_lower(shape_parameter("delay_span", "s", "s", {1.0, RelativeTo::sample_period},
                                                            {50.0, RelativeTo::sample_period}, Spacing::logarithmic))},
             .families = {EffectFamily::acceleration, EffectFamily::reversal, EffectFamily::measurement},
             .signature = {SignatureAxis::acceleration, SignatureAxis::since_velocity_reversal,
                           SignatureAxis::frequency},
             .parity = Parity::neither,
             .acts_on = ActsOn::recorded_torque,
             .needs_baseline = true,
             .is_torque_timing = true}) {}

 private:
  std::unique_ptr<EffectMemory> memory(std::span<double const> shape, JointScales const&,
                                       std::size_t lanes) const override {
    return memory_of(LateTorque(shape[0]), lanes);
  }
};

}  // namespace

Effect const& delay() {
  static Delay const effect;
  return effect;
}

}  // namespace torquescope::effects
