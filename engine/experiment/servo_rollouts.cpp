#include <cmath>

#include "engine/experiment/rollout_parts.hpp"
#include "engine/experiment/servo_rollouts.hpp"
#include "engine/fit/problem/plain_least_squares.hpp"
#include "engine/infer/decision/servo_start.hpp"
#include "engine/simulate/rollout/measured_drive.hpp"

namespace torquescope {
namespace {

using Eigen::Index;

// What the joint itself took of the motor's torque: rows of least squares know no loads of their own. Where no
// difference can be taken, at the ends, the known inertia takes nothing
void add_joint_torque(Recording& recording, RolloutTrack const& track, LoopNumbers const& loop, double motor_gain) {
  MeasuredDrive const drive = measured_drive(track, loop);
  Eigen::ArrayXd const acceleration = drive.acceleration.array().isFinite().select(drive.acceleration.array(), 0.0);
  recording.torque = motor_gain * drive.command.array() - track.known.gravity_moment * track.position.array().sin() -
                     track.known.inertia * acceleration;
}

RolloutData data_of(ServoJob const& servo, bool is_validation) {
  RolloutData data;
  data.tracks = is_validation ? servo.validation : servo.training;
  for (std::size_t k = 0; k < servo.entries.size(); ++k)
    if (servo.entries[k].is_validation == is_validation) data.recordings.push_back(servo.recordings[k]);
  data.origins.assign(data.tracks.size(), LoopOrigin::given);
  data.loop_words.assign(data.tracks.size(), "controller as the job gives it");
  data.velocity.resize(data.tracks.size());
  return data;
}

}  // namespace

ServoSources servo_sources(ServoJob const& servo) {
  ServoSources sources;
  ServoStart const start = servo_start(*servo.regressor, servo.loop, servo.training);
  for (std::size_t k = 0; k < servo.entries.size(); ++k) {
    Recording recording = servo.recordings[k];
    add_joint_torque(recording, servo.track(k), numbers_of(servo.loop.form, servo.loop.values), start.motor_gain);
    (servo.entries[k].is_validation ? sources.validate : sources.train).push_back(std::move(recording));
  }
  return sources;
}

void add_servo(RolloutParts& rollout, Regressor const& regressor, ServoJob const& servo, RegressionData const& rows) {
  rollout.train = data_of(servo, false);
  rollout.validate = data_of(servo, true);
  rollout.least_squares = plain_least_squares(rows, 0).parameters;
  ServoQuestion const question = servo.question(1);
  ServoBase const base = servo_base(question);
  LoopSetting setting = base.loop;
  // in the order in which the parameters were named before the data
  setting.free = loop_setting(rollout.plan.loop, 1.0).free;
  rollout.model.emplace(regressor, base.terms, base.scales, rollout.plan.effects, setting);
  rollout.variance = variance_at_start(rollout);
}

}  // namespace torquescope
