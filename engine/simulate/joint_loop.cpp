#include "engine/simulate/joint_loop.hpp"

#include <cmath>

namespace torquescope {

JointLoop::JointLoop(JointLoopOptions const& options, RandomKey const& key, double inertia, ReferencePoint const& start)
    : averages_(options.controller.torque_log == "averaged"),
      torque_limit_(options.controller.torque_limit),
      encoder_(options.encoder),
      controller_(options.controller, options.controller_rate_hz, inertia, start),
      position_noise_(key, NoiseStream::position, options.noise.position_std, 0.0, options.controller_rate_hz),
      disturbance_(key, NoiseStream::disturbance, options.noise.disturbance_std, options.noise.disturbance_s,
                   options.controller_rate_hz),
      white_(key, NoiseStream::torque_white, options.noise.torque_std, 0.0, options.recording_rate_hz),
      coloured_(key, NoiseStream::torque_coloured, options.noise.torque_coloured_std, options.noise.torque_coloured_s,
                options.recording_rate_hz) {}

LoopTick JointLoop::tick(ReferencePoint const& wanted, double position, double model_torque) {
  LoopTick now{};
  now.measured = encoder_.read(position + position_noise_.next());
  now.torque = controller_.command(wanted, now.measured, model_torque);
  now.acting = now.torque + disturbance_.next();
  return now;
}

double JointLoop::logged(LoopTick const& now) {
  double const log = averages_ && has_begun_ ? 0.5 * (torque_before_ + now.torque) : now.torque;
  return log + white_.next() + coloured_.next();
}

void JointLoop::pass(LoopTick const& now) {
  torque_before_ = now.torque;
  has_begun_ = true;
}

bool JointLoop::is_saturated(LoopTick const& now) const {
  return torque_limit_ > 0.0 && std::abs(now.torque) >= torque_limit_;
}

}  // namespace torquescope
