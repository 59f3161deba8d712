#include "servo/motion.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include "servo/chance.hpp"
#include "servo/servo_numbers.hpp"

namespace servo {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;
using Goal = std::function<double(double)>;

Goal two_sines(Chance& chance) {
  double const centre = chance.between(-0.4, 0.4), slow = chance.sign() * chance.between(0.4, 0.8);
  double const fast = chance.sign() * chance.between(0.15, 0.35);
  double const slow_hz = chance.between(0.3, 0.6), fast_hz = chance.between(1.0, 1.8);
  return [=](double t) { return centre + slow * std::sin(turn * slow_hz * t) + fast * std::sin(turn * fast_hz * t); };
}

Goal growing_sine(Chance& chance, double duration) {
  double const size = chance.sign() * chance.between(0.4, 0.8);
  double const last_hz = chance.between(1.5, 2.5);
  return [=](double t) { return size * std::sin(turn * 0.5 * last_hz * t * t / duration); };
}

struct Corner {
  double time, goal;
};

// Straight between corners, at the last goal after them
Goal polygon(std::vector<Corner> corners) {
  return [corners = std::move(corners)](double t) {
    for (std::size_t k = 1; k < corners.size(); ++k) {
      Corner const &from = corners[k - 1], &to = corners[k];
      if (t < to.time) return from.goal + (to.goal - from.goal) * (t - from.time) / (to.time - from.time);
    }
    return corners.back().goal;
  };
}

Goal up_and_down(Chance& chance, double duration) {
  std::vector<Corner> corners{{0.0, 0.0}, {0.2, 0.0}};
  double side = chance.sign();
  while (corners.back().time < duration) {
    double const top = side * chance.between(0.7, 1.5);
    corners.push_back({corners.back().time + chance.between(0.5, 1.3), top});
    corners.push_back({corners.back().time + chance.between(0.2, 0.5), top});
    side = -side;
  }
  return polygon(std::move(corners));
}

Goal steps(Chance& chance, double duration) {
  std::vector<Corner> levels{{0.0, 0.0}};  // each held from its time on
  double side = chance.sign();
  for (double time = 0.3; time < duration; time += chance.between(0.5, 1.1)) {
    levels.push_back({time, side * chance.between(0.3, 1.5)});
    if (chance.between(0.0, 1.0) < 0.7) side = -side;
  }
  return [levels = std::move(levels)](double t) {
    double goal = 0.0;
    for (Corner const& level : levels) goal = t >= level.time ? level.goal : goal;
    return goal;
  };
}

Goal lift(Chance& chance, double lifted_s) {
  double const top = chance.sign() * chance.between(1.4, 1.6);
  return polygon({{0.0, 0.0}, {0.2, 0.0}, {0.8 * lifted_s, top}});
}

}  // namespace

std::string to_text(Kind kind) {
  switch (kind) {
    case Kind::two_sines:
      return "two_sines";
    case Kind::up_and_down:
      return "up_and_down";
    case Kind::steps:
      return "steps";
    case Kind::lift_and_drop:
      return "lift_and_drop";
    case Kind::growing_sine:
      break;
  }
  return "growing_sine";
}

std::vector<Sample> draw_motion(MotionOptions const& options, int number, std::uint64_t recording) {
  auto const kind = static_cast<Kind>(number % n_kinds);
  Chance chance{options.seed, Purpose::motion, static_cast<std::uint64_t>(number)};
  double const lifted_s = options.duration_s * chance.between(0.33, 0.45);
  Goal goal;
  if (kind == Kind::two_sines) goal = two_sines(chance);
  if (kind == Kind::up_and_down) goal = up_and_down(chance, options.duration_s);
  if (kind == Kind::steps) goal = steps(chance, options.duration_s);
  if (kind == Kind::lift_and_drop) goal = lift(chance, lifted_s);
  if (kind == Kind::growing_sine) goal = growing_sine(chance, options.duration_s);

  Chance clock{options.seed, Purpose::clock, recording};
  std::vector<Sample> samples;
  auto const n_samples = static_cast<int>(std::lround(options.duration_s / log_period_s));
  for (int k = 0; k < n_samples; ++k) {
    double const late = k > 0 ? clock.between(-options.jitter_s, options.jitter_s) : 0.0;
    double const time = step_s * std::round((k * log_period_s + late) / step_s);
    double const rounded = 1e-4 * std::round(1e4 * goal(time));
    samples.push_back({time, rounded, kind != Kind::lift_and_drop || time < lifted_s});
  }
  return samples;
}

}  // namespace servo
