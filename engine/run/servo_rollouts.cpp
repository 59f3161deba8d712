#include <cmath>

#include "engine/decision/servo_start.hpp"
#include "engine/problem/plain_least_squares.hpp"
#include "engine/run/rollout_parts.hpp"
#include "engine/run/servo_rollouts.hpp"

namespace torquescope {
namespace {

using Eigen::Index;

// what the joint itself took of the motor's torque: rows of least squares know no loads of their own
void add_joint_torque(Recording& recording, RolloutTrack const& track, LoopNumbers const& loop, double motor_gain) {
  constexpr double span_s = 0.05;
  Index const n = recording.position.size(), span = std::max<Index>(1, std::llround(span_s * track.rate_hz));
  double const apart_s = static_cast<double>(span) / track.rate_hz;
  double const most = std::min(loop.most, track.known.command_limit);
  recording.torque.resize(n);
  for (Index k = 0; k < n; ++k) {
    double const here = recording.position[k], before = recording.position[std::max<Index>(k - span, 0)];
    double const after = recording.position[std::min(k + span, n - 1)];
    double const is_on = recording.enabled.size() > 0 ? recording.enabled[k] : 1.0;
    double const command =
        is_on * std::clamp(loop.kp * track.known.command_gain * (recording.reference[k] - here), -most, most);
    recording.torque[k] = motor_gain * command - track.known.gravity_moment * std::sin(here) -
                          track.known.inertia * (after - 2.0 * here + before) / (apart_s * apart_s);
  }
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
  for (auto const& name : rollout.plan.loop.fit) {
    auto const key = loop_key_of(name);
    if (key && std::find(setting.free.begin(), setting.free.end(), *key) == setting.free.end())
      setting.free.push_back(*key);
  }
  // in the order in which the parameters were named before the data
  std::vector<LoopKey> ordered;
  for (LoopKey const key : loop_setting(rollout.plan.loop, 1.0).free) ordered.push_back(key);
  setting.free = ordered;
  rollout.model.emplace(regressor, base.terms, base.scales, rollout.plan.effects, setting);
  rollout.variance = variance_at_start(rollout);
}

}  // namespace torquescope
