// Reference motions: a sum of sines, or strokes of least jerk between random places, with stops and rests.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sticking/rig.hpp"

namespace sticking {
namespace {

constexpr double fade_s = 1.0;
constexpr double highest_hz = 1.8;

double least_jerk(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10.0 + x * (-15.0 + 6.0 * x));
}

void fit_into(MotionLimits const& limits, double rate_hz, std::vector<double>& path) {
  double widest = 0.0, fastest = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    widest = std::max(widest, std::abs(path[i]));
    if (i > 0) fastest = std::max(fastest, std::abs(path[i] - path[i - 1]) * rate_hz);
  }
  double const scale = std::min(0.5 * limits.travel / widest, limits.speed / fastest);
  for (double& q : path) q = limits.centre + scale * q;
}

std::vector<double> sines(MotionLimits const& limits, double rate_hz, Chance& chance) {
  struct Wave {
    double amplitude, omega, phase;
  };
  double const usual_hz = limits.speed / (std::numbers::pi * limits.travel);
  std::vector<Wave> waves(4 + chance.index(4));
  double const slope = chance.between(0.3, 1.0);
  for (Wave& wave : waves) {
    double const hz = chance.log_between(0.25 * usual_hz, std::min(4.0 * usual_hz, highest_hz));
    wave = {std::pow(usual_hz / hz, slope) * chance.between(0.5, 1.0), turn * hz, chance.angle()};
  }
  std::vector<double> path(static_cast<std::size_t>(std::lround(duration_s * rate_hz)), 0.0);
  for (std::size_t i = 0; i < path.size(); ++i) {
    double const t = static_cast<double>(i) / rate_hz;
    for (Wave const& wave : waves) path[i] += wave.amplitude * std::sin(wave.omega * t + wave.phase);
    path[i] *= least_jerk(t / fade_s) * least_jerk((duration_s - t) / fade_s);
  }
  fit_into(limits, rate_hz, path);
  return path;
}

std::vector<double> strokes(MotionLimits const& limits, double rate_hz, Chance& chance) {
  constexpr double peak_of_mean = 1.875;  // speed of a stroke of least jerk
  auto const n = static_cast<std::size_t>(std::lround(duration_s * rate_hz));
  std::vector<double> path;
  path.reserve(n + 1);
  double here = 0.0;
  auto const rest = [&](double seconds) {
    path.insert(path.end(), static_cast<std::size_t>(std::lround(seconds * rate_hz)), limits.centre + here);
  };
  rest(0.3);
  while (path.size() < n) {
    // a third of the strokes are short
    double const reach = 0.5 * limits.travel * (chance.happens(0.33) ? 0.3 : 1.6);
    double const to = std::clamp(here + reach * chance.between(-1.0, 1.0), -0.5 * limits.travel, 0.5 * limits.travel);
    double const speed = limits.speed * chance.log_between(0.12, 1.0);
    double const seconds = std::max(0.35, peak_of_mean * std::abs(to - here) / speed);
    auto const ticks = static_cast<std::size_t>(std::lround(seconds * rate_hz));
    for (std::size_t i = 1; i <= ticks; ++i)
      path.push_back(limits.centre + here +
                     (to - here) * least_jerk(static_cast<double>(i) / static_cast<double>(ticks)));
    here = to;
    if (chance.happens(limits.resting_share)) rest(chance.between(0.1, 1.0));
  }
  path.resize(n);
  return path;
}

}  // namespace

std::vector<double> draw_motion(MotionLimits limits, double rate_hz, Chance chance, bool is_other) {
  if (is_other) {  // another such motion: as fast or a little slower, over as much of the travel or a little less
    limits.speed *= chance.between(0.75, 1.0);
    limits.travel *= chance.between(0.8, 1.0);
  }
  return limits.strokes ? strokes(limits, rate_hz, chance) : sines(limits, rate_hz, chance);
}

}  // namespace sticking
