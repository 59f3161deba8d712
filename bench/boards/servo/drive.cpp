#include "servo/drive.hpp"

#include <algorithm>
#include <cmath>

namespace servo {
namespace {

constexpr double tick_s = steps_per_tick * step_s;
constexpr double rounding = 1e-12;  // rad between a led goal and one that has been reached

}  // namespace

// The greatest speed from which whole ticks of braking end within the way: with c = acceleration tick, n ticks slow
// down by c each and one by the rest r, so that way = tick (r (n + 1) + c n (n + 1) / 2) and the speed is r + n c
double LedGoal::arriving_speed(double way) const {
  if (std::isinf(acceleration_limit_)) return std::min(speed_limit_, way / tick_s);
  double const change = acceleration_limit_ * tick_s;
  double const ways = way / (change * tick_s);
  double const n = std::floor(0.5 * (std::sqrt(1.0 + 8.0 * ways) - 1.0));
  return std::min(speed_limit_, change * (ways / (n + 1.0) + 0.5 * n));
}

double LedGoal::tick(double wanted) {
  double const way = wanted - goal_;
  double const aim = std::copysign(arriving_speed(std::abs(way)), way);
  double const change = acceleration_limit_ * tick_s;
  speed_ = std::clamp(aim, speed_ - change, speed_ + change);
  goal_ = std::abs(speed_ * tick_s - way) < rounding ? wanted : goal_ + speed_ * tick_s;
  return goal_;
}

Drive::Drive(ServoNumbers const& servo, Setting const& setting, double start)
    : servo_(servo),
      gain_(setting.command_gain()),
      limit_(setting.command_limit()),
      share_(servo.torque_lag_s > 0.0 ? -std::expm1(-step_s / servo.torque_lag_s) : 1.0),
      led_(servo.goal_speed_limit, servo.goal_acceleration_limit, start) {}

double Drive::command(double error) const {
  if (error == 0.0 || std::abs(error) < servo_.dead_band) return 0.0;
  double const least = std::max(std::abs(gain_ * error), servo_.punch);
  return std::copysign(std::min(least, limit_), error);
}

void Drive::tick(double wanted, double read) { command_ = command(led_.tick(wanted) - read); }

double Drive::step(bool is_on) {
  lagged_ = is_on ? lagged_ + share_ * (command_ - lagged_) : 0.0;
  return lagged_;
}

}  // namespace servo
