#pragma once
// The [loop] section of a job: which controller led the recordings, and what lies between it and the joint.
//
// Errors     problems are appended (78): unknown words, gains of another controller
// Threads    plain record, free functions

#include <limits>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/simulate/rollout/rollout_model.hpp"
#include "engine/simulate/rollout/rollout_residuals.hpp"
#include "engine/simulate/rollout/track.hpp"

namespace torquescope {

struct LoopOptions {
  std::string controller = "identified";
  std::string drive{};  // of a set of recordings
  double rate_hz = 0.0;
  std::string reference = "held";
  std::string speed = "difference";
  std::int64_t speed_samples = 0;
  std::vector<std::string> fit{};
  std::vector<std::string> channels{"position", "torque"};
  double window_s = 0.05;
  // NaN: not given; in the order of LoopKey
  static constexpr double not_given = std::numeric_limits<double>::quiet_NaN();
  double kp = not_given, ki = not_given, kd = not_given, kv = not_given;
  double feed_speed = not_given, feed_acceleration = not_given, added_command_gain = not_given;
  double torque_limit = not_given, speed_lag_s = not_given, back_emf = not_given;
  double goal_speed_limit = not_given, goal_acceleration_limit = not_given;
  double command_delay_s = not_given, torque_delay_s = not_given, torque_lag_s = not_given,
         torque_log_lag_s = not_given;
  double motor_gain = not_given, dead_band = not_given, punch = not_given;
  double load_friction = not_given, load_square_friction = not_given, stribeck_friction = not_given,
         stribeck_speed = not_given, load_stribeck_friction = not_given;
  double arm_mass = not_given, motor_gain_per_kelvin = not_given, load_motor_share = not_given;
  double angle_friction_cos = not_given, angle_friction_sin = not_given;

  static OptionTable<LoopOptions> const& table();
};

// what does not go together, at its place
void check_loop(LoopOptions const& options, Section const& section, std::vector<Problem>& problems);

LoopForm form_of(LoopOptions const& options);
TrackOptions track_options(LoopOptions const& options);
CountedChannels channels_of(LoopOptions const& options);

// what the job says; gains that it leaves out are free and wait for their first values
LoopSetting loop_setting(LoopOptions const& options, double recording_rate_hz);
std::vector<LoopKey> missing_gains(LoopOptions const& options);

}  // namespace torquescope
