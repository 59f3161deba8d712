#include "stranger/path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stranger {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

double fade(double t, double duration_s) {
  double const ramp = std::clamp(std::min(t, duration_s - t) / std::min(1.0, duration_s / 4), 0.0, 1.0);
  return ramp * ramp * (3 - 2 * ramp);
}

}  // namespace

void Path::rest(double duration_s) {
  positions_.insert(positions_.end(), static_cast<std::size_t>(duration_s / tick_s_), here());
}

void Path::trapezoid(double to, double speed, double acceleration) {
  double const from = here();
  double const distance = std::abs(to - from);
  double const side = to > from ? 1 : -1;
  double const top = std::min(speed, std::sqrt(distance * acceleration));
  double const rising_s = top / acceleration;
  double const total_s = distance > 0 ? distance / top + rising_s : 0;
  for (double t = tick_s_; t < total_s; t += tick_s_) {
    double gone = 0;
    if (t < rising_s) {
      gone = acceleration * t * t / 2;
    } else if (t < total_s - rising_s) {
      gone = top * (t - rising_s / 2);
    } else {
      gone = distance - acceleration * (total_s - t) * (total_s - t) / 2;
    }
    positions_.push_back(from + side * gone);
  }
  positions_.push_back(to);
}

void Path::min_jerk(double to, double duration_s) {
  double const from = here();
  for (double t = tick_s_; t < duration_s; t += tick_s_) {
    double const s = t / duration_s;
    positions_.push_back(from + (to - from) * s * s * s * (10 - 15 * s + 6 * s * s));
  }
  positions_.push_back(to);
}

void Path::multisine(Chance& chance, double duration_s, double reach, double top_speed, double from_hz, double to_hz) {
  constexpr int n_lines = 9;
  double hz[n_lines];
  double phase[n_lines];
  double size[n_lines];
  for (int line = 0; line < n_lines; ++line) {
    hz[line] = from_hz * std::pow(to_hz / from_hz, (line + chance.between(-0.3, 0.3)) / (n_lines - 1));
    phase[line] = chance.between(0, two_pi);
    size[line] = chance.between(0.6, 1.0) / (0.3 + hz[line] / from_hz);
  }
  auto wave = [&](double t) {
    double sum = 0;
    for (int line = 0; line < n_lines; ++line) sum += size[line] * std::sin(two_pi * hz[line] * t + phase[line]);
    return sum;
  };
  double farthest = 1e-12;
  double fastest = 1e-12;
  for (double t = 0; t < duration_s; t += 0.004) {
    farthest = std::max(farthest, std::abs(wave(t)));
    fastest = std::max(fastest, std::abs(wave(t + 0.001) - wave(t - 0.001)) / 0.002);
  }
  double const scale = std::min(reach / farthest, top_speed / fastest);
  double const middle = here();
  for (double t = tick_s_; t < duration_s; t += tick_s_)
    positions_.push_back(middle + scale * fade(t, duration_s) * wave(t));
  positions_.push_back(middle);
}

void Path::chirp(double duration_s, double reach, double top_speed, double from_hz, double to_hz) {
  double const middle = here();
  double const growth = std::log(to_hz / from_hz) / duration_s;
  for (double t = tick_s_; t < duration_s; t += tick_s_) {
    double const hz = from_hz * std::exp(growth * t);
    double const turns = std::abs(growth) < 1e-12 ? from_hz * t : from_hz * std::expm1(growth * t) / growth;
    double const size = std::min(reach, top_speed / (two_pi * hz));
    positions_.push_back(middle + size * fade(t, duration_s) * std::sin(two_pi * turns));
  }
  positions_.push_back(middle);
}

}  // namespace stranger
