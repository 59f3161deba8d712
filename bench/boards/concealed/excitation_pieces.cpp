// Pieces of reference motions that machines make rather than identification: sweeps, cycles, errands, turning on.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "concealed/excitation.hpp"
#include "concealed/noise.hpp"

namespace concealed {

void Excitation::add_chirp(double length) {
  double const two_pi = 2.0 * std::numbers::pi, lowest_hz = 0.15, highest_hz = 2.5;
  double const rate = std::log(highest_hz / lowest_hz) / length;
  MotionLimits const limits = limits_;
  auto sweep = [=](double t) {
    // large while slow, at constant speed amplitude from where range and speed meet
    double const omega = two_pi * lowest_hz * std::exp(rate * t);
    double const amplitude = 1.0 / std::hypot(1.0 / limits.range, omega / limits.speed);
    return amplitude * std::sin((omega - two_pi * lowest_hz) / rate);
  };
  double const scale = scale_to_limits(length, sweep);
  add_faded(length, [=](double t) { return scale * sweep(t); });
}

void Excitation::glide_to(double target, double speed) {
  double const from = here_, way = target - from;
  // peak speed 15/8 way/T, peak acceleration 10/sqrt(3) way/T^2 of the fifth-order move
  double const by_speed = 1.875 * std::abs(way) / speed;
  double const by_acceleration = std::sqrt(5.7735 * std::abs(way) * speed_up_s / limits_.speed);
  double const length = std::max(by_speed, by_acceleration);
  add(length, [=](double t) {
    double const x = t / length;
    return from + way * x * x * x * (10.0 + x * (-15.0 + 6.0 * x));
  });
  here_ = target;
}

void Excitation::add_cycles(double length, std::uint64_t seed) {
  Random random(seed, "poses");
  double const stop = end_time() + length - 5.0 - 2.0 * limits_.range / limits_.speed;
  double const fast = random.between(0.5, 1.0) * limits_.speed, approach = 0.06 * limits_.range;
  std::vector<double> poses;
  for (double place : {-0.85, 0.3, 0.8, -0.25}) poses.push_back((place + random.between(-0.1, 0.1)) * limits_.range);
  for (std::size_t i = 0; end_time() < stop; ++i) {
    double const pose = poses[i % poses.size()], side = pose > here_ ? 1.0 : -1.0;
    glide_to(pose - side * approach, fast);
    glide_to(pose, 0.08 * limits_.speed);
    dwell(random.between(0.15, 0.4));
  }
  glide_to(0.0, fast);
  dwell(length);
}

void Excitation::add_errands(double length, std::uint64_t seed) {
  Random random(seed, "errands");
  double const stop = end_time() + length - 1.0;
  for (int refused = 0; refused < 20;) {
    double const target = random.between(-1.0, 1.0) * limits_.range;
    double const speed = limits_.speed * std::exp(random.between(std::log(0.06), 0.0));
    double const rest_s = random.between(0.05, 0.5);
    double const longest_s = 1.875 * std::abs(target - here_) / speed + 4.0 * speed_up_s + rest_s;
    double const home_s = 1.875 * std::abs(target) / limits_.speed + 4.0 * speed_up_s;
    if (longest_s > 0.15 * length || end_time() + longest_s + home_s > stop) {
      ++refused;
      continue;
    }
    refused = 0;
    random.uniform() < 0.7 ? glide_to(target, speed) : stroke_to(target, speed);
    dwell(rest_s);
  }
  glide_to(0.0, limits_.speed);
  dwell(length);
}

void Excitation::add_turning(double length, std::uint64_t seed) {
  Random random(seed, "turning");
  double const stop = end_time() + length - 3.0, change_s = 0.4;
  double v = 0.0;
  auto change_to = [&](double next) {
    double const a = (next - v) / change_s;
    add_parabola(change_s, here_, v, a);
    here_ += 0.5 * (v + next) * change_s;
    v = next;
  };
  while (end_time() < stop) {
    change_to(limits_.speed * random.between(0.1, 1.0));
    double const cruise_s = random.between(0.8, 2.0);
    add_parabola(cruise_s, here_, v, 0.0);
    here_ += v * cruise_s;
  }
  change_to(0.0);
  dwell(length);
}

}  // namespace concealed
