#pragma once
// The engine's words for a plain joint and its loop (plain_loop.hpp), and the collected rows of a rollout.

#include <Eigen/Core>
#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "engine/simulate/rollout/loop_form.hpp"
#include "engine/simulate/rollout/rollout.hpp"
#include "unit/rollout/plain_loop.hpp"

namespace torquescope::test {

inline Eigen::VectorXd vector_of(std::vector<double> const& values) {
  return Eigen::Map<Eigen::VectorXd const>(values.data(), static_cast<Eigen::Index>(values.size()));
}

inline LoopValues values_of(PlainController const& plain) {
  using enum LoopKey;
  LoopValues values;
  values[kp] = plain.kp;
  values[ki] = plain.ki;
  values[kd] = plain.kd;
  values[kv] = plain.kv;
  values[feed_speed] = plain.feed_speed;
  values[feed_acceleration] = plain.feed_acceleration;
  values[added_command_gain] = plain.added_gain;
  values[torque_limit] = plain.limit;
  values[speed_lag_s] = plain.speed_lag_s;
  values[back_emf] = plain.back_emf;
  values[command_delay_s] = plain.command_delay_s;
  values[torque_delay_s] = plain.torque_delay_s;
  values[torque_lag_s] = plain.torque_lag_s;
  values[torque_log_lag_s] = plain.log_lag_s;
  return values;
}

inline RolloutTrial trial_of(PlainJoint const& joint, PlainController const& controller) {
  RolloutTrial trial;
  trial.joint = {joint.inertia, joint.viscous, joint.gravity_sin, joint.gravity_cos};
  trial.forward = joint.forward;
  trial.backward = joint.backward;
  trial.offset = joint.offset;
  trial.loop = numbers_of(*loop_form_of(controller.form), values_of(controller));
  return trial;
}

// the inputs, beside a measured motion: of zeros where none is given
inline RolloutTrack track_of(PlainInputs const& inputs, PlainStart const& start, PlainMotion const& motion = {}) {
  RolloutTrack track;
  auto const n = static_cast<Eigen::Index>(inputs.reference.size());
  track.name = "plain";
  track.rate_hz = inputs.rate_hz;
  track.ticks_per_sample = static_cast<std::size_t>(inputs.ticks_per_sample);
  track.straight_reference = inputs.straight;
  track.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1) / inputs.rate_hz);
  track.reference = vector_of(inputs.reference);
  track.position = motion.position.empty() ? track.reference : vector_of(motion.position);
  track.torque = motion.torque.empty() ? Eigen::VectorXd::Zero(n) : vector_of(motion.torque);
  track.added = vector_of(inputs.added);
  track.outside = vector_of(inputs.outside);
  track.enabled = vector_of(inputs.enabled);
  track.segments = {{0, n, start.position, start.velocity, start.torque}};
  return track;
}

inline RolloutStructure structure_of(PlainController const& controller, double step_s = 1e-3) {
  RolloutStructure structure;
  structure.hold_ticks = static_cast<std::size_t>(controller.hold);
  structure.speed_samples = static_cast<std::size_t>(controller.span);
  structure.step_s = step_s;
  return structure;
}

// [samples][trials] of the whole track; NaN where nothing was simulated
struct Rolled {
  Eigen::MatrixXd position, velocity, torque;
};

inline Rolled rolled(RolloutTrack const& track, RolloutStructure const& structure,
                     std::vector<RolloutTrial> const& trials) {
  auto const lanes = static_cast<Eigen::Index>(trials.size());
  Rolled all;
  for (auto* channel : {&all.position, &all.velocity, &all.torque})
    *channel = Eigen::MatrixXd::Constant(track.position.size(), lanes, std::nan(""));
  roll_out(track, structure, trials, [&](RolloutRows const& rows) {
    for (Eigen::Index k = 0; k < rows.samples; ++k)
      for (Eigen::Index lane = 0; lane < lanes; ++lane) {
        auto const at = static_cast<std::size_t>(k) * replicate_lanes + static_cast<std::size_t>(lane);
        all.position(rows.first + k, lane) = rows.position[at];
        all.velocity(rows.first + k, lane) = rows.velocity[at];
        all.torque(rows.first + k, lane) = rows.torque[at];
      }
  });
  return all;
}

inline bool same_bits(Eigen::MatrixXd const& a, Eigen::MatrixXd const& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

// three waves, at rest to begin with; samples at rate_hz
inline std::vector<double> waves(int samples, double rate_hz, double size = 1.0) {
  std::vector<double> reference;
  for (int k = 0; k < samples; ++k) {
    double const turn = 2.0 * std::numbers::pi * k / rate_hz;
    reference.push_back(size * (0.5 * (1.0 - std::cos(0.7 * turn)) + 0.2 * (1.0 - std::cos(1.9 * turn)) -
                                0.05 * (1.0 - std::cos(4.3 * turn))));
  }
  return reference;
}

}  // namespace torquescope::test
