// Numbers of a loop and of a gear, put into one lane of those that run side by side (loop_lanes.cpp), and its start.

#include <algorithm>
#include <cmath>

#include "engine/simulate/rollout/loop_lanes.hpp"

namespace torquescope {
namespace {

// share of a first-order lag that is left after a tick, and its mean over the tick; 0, 0 without a lag
struct LagOfTick {
  double end = 0.0, mean = 0.0;
  LagOfTick(double lag_s, double tick_s) {
    if (!(lag_s > 0.0)) return;
    double const ticks = tick_s / lag_s;
    end = std::exp(-ticks);
    mean = -std::expm1(-ticks) / ticks;
  }
};

}  // namespace

LaneLoops::LaneLoops(double tick_s_, std::size_t hold_ticks_, std::size_t speed_samples_)
    : tick_s(tick_s_),
      hold_ticks(hold_ticks_),
      speed_samples(speed_samples_),
      period_s(tick_s_ * static_cast<double>(hold_ticks_)),
      per_period(1.0 / period_s),
      per_span(1.0 / (period_s * static_cast<double>(std::max<std::size_t>(1, speed_samples_)))) {}

void LaneLoops::set(std::size_t lane, LoopNumbers const& numbers) {
  kp[lane] = numbers.kp;
  kd[lane] = numbers.kd;
  ki[lane] = numbers.ki;
  ki_speed[lane] = numbers.ki_speed;
  feed_speed[lane] = numbers.feed_speed;
  feed_acceleration[lane] = numbers.feed_acceleration;
  added_gain[lane] = numbers.added_gain;
  least[lane] = numbers.least;
  most[lane] = numbers.most;
  back_emf[lane] = numbers.back_emf;
  motor_gain[lane] = numbers.motor_gain;
  dead_band[lane] = numbers.dead_band;
  punch[lane] = numbers.punch;
  goal_step[lane] = numbers.goal_speed * tick_s;
  goal_change[lane] = numbers.goal_acceleration * tick_s * tick_s;
  speed_share[lane] = 1.0 - LagOfTick(numbers.speed_lag_s, tick_s * static_cast<double>(hold_ticks)).end;
  log_share[lane] = 1.0 - LagOfTick(numbers.log_lag_s, tick_s).end;
  LagOfTick const lag(numbers.torque_lag_s, tick_s);
  lag_end[lane] = lag.end;
  lag_mean[lane] = lag.mean;
  double const late = std::clamp(numbers.torque_delay_s / tick_s, 0.0, static_cast<double>(most_delay_ticks - 2));
  late_ticks[lane] = static_cast<std::size_t>(late);
  late_share[lane] = late - std::floor(late);
  has_profile = has_profile || std::isfinite(numbers.goal_speed) || std::isfinite(numbers.goal_acceleration);
  has_feed = has_feed || numbers.feed_speed != 0.0 || numbers.feed_acceleration != 0.0;
  has_integral = has_integral || numbers.ki != 0.0 || numbers.ki_speed != 0.0;
  has_delay = has_delay || late > 0.0;
  has_lag = has_lag || lag.end > 0.0;
  has_least_drive = has_least_drive || numbers.dead_band > 0.0 || numbers.punch > 0.0;
}

void LaneLoops::set_encoder(std::size_t lane, double step, double phase) {
  encoder_step[lane] = step;
  encoder_phase[lane] = phase;
  has_encoder = has_encoder || step > 0.0;
}

void LaneGears::set(std::size_t lane, GearFriction const& gear) {
  load[lane] = gear.load;
  load_square[lane] = gear.load_square;
  stribeck[lane] = gear.stribeck;
  load_stribeck[lane] = gear.load_stribeck;
  per_speed[lane] = 1.0 / gear.stribeck_speed;
  motor_share[lane] = gear.motor_share;
  angle_cos[lane] = gear.angle_cos;
  angle_sin[lane] = gear.angle_sin;
  any = any || !gear.is_none();
  turns = turns || gear.turns();
}

void LaneLoopState::start(LaneLoops const& loops, LaneState const& joint, double const* first_goal, double torque) {
  clock = {};
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    goal[lane] = goal_before[lane] = first_goal[lane];
    goal_speed[lane] = 0.0;
    goal_step_before[lane] = 0.0;
    speed[lane] = joint.dq[lane];
    // before the start the joint came along at its first velocity; the first answer overwrites the oldest
    for (std::size_t k = 0; k < loops.speed_samples; ++k)
      reads[k][lane] = joint.q[lane] - joint.dq[lane] * loops.period_s * static_cast<double>(loops.speed_samples - k);
    double const rest = loops.kp[lane] * (first_goal[lane] - joint.q[lane]) - loops.kd[lane] * joint.dq[lane];
    bool const sums = loops.ki[lane] != 0.0 || loops.ki_speed[lane] != 0.0;
    double const before = std::isnan(torque) ? std::clamp(rest, loops.least[lane], loops.most[lane]) : torque;
    integral[lane] = sums ? before - rest : 0.0;
    command[lane] = lagged[lane] = logged[lane] = before;
  }
  for (auto& row : commands) std::copy_n(command, replicate_lanes, row);
}

}  // namespace torquescope
