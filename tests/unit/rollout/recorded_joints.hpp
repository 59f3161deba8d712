#pragma once
// Recordings of plain joints (plain_loop.hpp) as sensors show them, and models that a fit of them begins with.

#include <cmath>
#include <string>
#include <vector>

#include "engine/base/random_stream.hpp"
#include "engine/simulate/rollout/loop_gains.hpp"
#include "engine/simulate/rollout/rollout_fit.hpp"
#include "engine/simulate/rollout/rollout_model.hpp"
#include "unit/rollout/loops.hpp"

namespace torquescope::test {

struct Sensors {
  double encoder_step = 5e-5, torque_noise = 0.02;
  std::uint64_t seed = 1;
};

// begins at rest on the first reference
inline RolloutTrack recorded(PlainJoint const& joint, PlainController const& controller, PlainInputs const& inputs,
                             Sensors const& sensors) {
  PlainStart const start{inputs.reference.front(), 0.0, 0.0};
  constexpr int steps_per_tick = 10;
  PlainMotion motion = PlainLoop(joint, controller, inputs, start, steps_per_tick, sensors.encoder_step).run();
  RandomStream random({sensors.seed, 0, RandomDomain::test}, 0, 0);
  for (double& torque : motion.torque) torque += sensors.torque_noise * random.normal();
  RolloutTrack track = track_of(inputs, {motion.position.front(), 0.0, 0.0}, motion);
  track.encoder_step = sensors.encoder_step;
  return track;
}

inline JointScales scales_of(RolloutTrack const& track, PlainJoint const& joint) {
  JointScales scales;
  scales.rate_hz = track.rate_hz;
  scales.duration_s = track.time_s[track.time_s.size() - 1];
  scales.cutoff_hz = 0.1 * track.rate_hz;
  auto const n = track.position.size();
  constexpr int apart = 5;
  Eigen::VectorXd const way = track.position.tail(n - apart) - track.position.head(n - apart);
  scales.peak_speed = way.cwiseAbs().maxCoeff() * track.rate_hz / apart;
  scales.position_range = track.position.maxCoeff() - track.position.minCoeff();
  scales.position_centre = 0.5 * (track.position.maxCoeff() + track.position.minCoeff());
  scales.encoder_step = track.encoder_step;
  scales.torque_rms = std::sqrt(track.torque.squaredNorm() / static_cast<double>(n));
  scales.torque_peak = track.torque.cwiseAbs().maxCoeff();
  scales.torque_highest = std::max(0.0, track.torque.maxCoeff());
  scales.torque_lowest = std::max(0.0, -track.torque.minCoeff());
  scales.coulomb_positive = joint.forward;
  scales.coulomb_negative = -joint.backward;
  scales.inertia = joint.inertia;
  scales.viscous = joint.viscous;
  return scales;
}

// a joint's parameters in the order of these terms
inline std::vector<std::string> const& joint_terms() {
  static std::vector<std::string> const terms{"inertia", "viscous", "coulomb", "offset"};
  return terms;
}
inline Eigen::VectorXd truth_of(PlainJoint const& joint) {
  return Eigen::Vector4d(joint.inertia, joint.viscous, joint.forward, joint.offset);
}

// the gains of the form are free, their first values those of the recording
inline LoopSetting free_loop(PlainController const& controller, std::vector<RolloutTrack> const& tracks) {
  LoopSetting setting;
  setting.form = *loop_form_of(controller.form);
  setting.values = values_of(controller);
  setting.free = gains_of(setting.form);
  setting.speed_samples = static_cast<std::size_t>(controller.span);
  for (LoopKey const key : setting.free) setting.values[key] = 0.0;
  setting.values = with_first_gains(setting.form, setting.values, setting.free, setting.speed_samples, tracks);
  return setting;
}

inline PlainJoint dry_joint() {
  PlainJoint joint;
  joint.forward = 0.3;
  joint.backward = -0.3;
  joint.offset = 0.1;
  return joint;
}

inline PlainController controller_of(std::string const& form) {
  bool const is_cascade = form == "p_velocity" || form == "p_pi", is_soft = form == "p" || form == "pi";
  return {form, is_cascade ? 12.0 : is_soft ? 6.0 : 18.0, form == "p_pi" ? 9.0 : is_soft ? 4.0 : 30.0, 1.1, 1.2};
}

inline PlainInputs moved(int samples, double rate_hz = 500.0) {
  PlainInputs inputs;
  inputs.rate_hz = rate_hz;
  inputs.reference = waves(samples, rate_hz);
  return inputs;
}

}  // namespace torquescope::test
