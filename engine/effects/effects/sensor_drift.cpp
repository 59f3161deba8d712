// A torque channel whose zero creeps or jumps.
//
// Equation   recorded = true + b (t - start) + b_s [t >= t_c]
// Parameters sensor_drift b [N m/s; N/s], sensor_step b_s [N m; N], either sign; sensor_step_time t_c [s]
// Signature  time, whatever the motion
// Confused   gravity while the joint hardly turns, payload_change
// Source     FloBaRoID, recordings of a KUKA LWR: 0.1 to 0.9 N m

#include "engine/effects/instant_effect.hpp"

namespace torquescope::effects {
namespace {

class SensorDrift final : public InstantEffect {
 public:
  SensorDrift()
      : InstantEffect(
            {.name = "sensor_drift",
             .title = "torque channel whose zero creeps or jumps",
             .equation = "recorded torque + b (t - start) + b_s [t >= t_c]",
             .source = "FloBaRoID, recordings of a KUKA LWR (0.1 to 0.9 N m)",
             .separated_by = "holds in the same position at the start and the end",
             .parameters = {{"sensor_drift",
                             "N m/s",
                             "N/s",
                             {-1.0, RelativeTo::torque_per_duration},
                             {1.0, RelativeTo::torque_per_duration}},
                            {"sensor_step", "N m", "N", {-1.0, RelativeTo::torque}, {1.0, RelativeTo::torque}},
                            shape_parameter("sensor_step_time", "s", "s", {0.05, RelativeTo::instant},
                                            {0.95, RelativeTo::instant}, Spacing::linear)},
             .families = {EffectFamily::time, EffectFamily::static_position, EffectFamily::measurement},
             .signature = {SignatureAxis::time},
             .parity = Parity::even,
             .acts_on = ActsOn::recorded_torque}) {}

 private:
  void evaluate(JointStates const& at, std::span<double const> shape, JointScales const& scales,
                EffectColumns out) const override {
    out.col(0) = at.time_s - scales.start_s;
    out.col(1) = is_after(at.time_s, shape[0]);
  }
};

}  // namespace

Effect const& sensor_drift() {
  static SensorDrift const effect;
  return effect;
}

}  // namespace torquescope::effects
