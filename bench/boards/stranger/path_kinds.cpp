// What laboratories and factories move: each kind fills the recording's time with its own moves.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "stranger/path.hpp"

namespace stranger {
namespace {

struct Limits {
  double centre, reach, speed, acceleration;
};

void trapezoids(Path& path, Limits const& limit, Chance& chance) {
  double const to = limit.centre + limit.reach * chance.between(-1, 1);
  path.trapezoid(to, limit.speed * chance.between(0.12, 1), limit.acceleration * chance.between(0.4, 1));
  path.rest(chance.between(0.02, 0.35));
}

void pick_place(Path& path, Limits const& limit, Chance& chance, int stop) {
  static constexpr double stations[] = {-0.85, 0.55, -0.3, 0.9, 0.1};
  double const to = limit.centre + limit.reach * (stations[stop % 5] + chance.between(-0.1, 0.1));
  double const fastest_s = 1.875 * std::abs(to - path.here()) / limit.speed;
  path.min_jerk(to, std::max(0.25, fastest_s * chance.between(1.0, 2.6)));
  path.rest(chance.between(0.05, 0.6));
}

// a hand that leads the joint: hesitating moves of all lengths, some reversed at once
void irregular(Path& path, Limits const& limit, Chance& chance) {
  double const share = chance.uniform() < 0.4 ? 0.25 : 1.2;
  double const to = std::clamp(path.here() + limit.reach * share * chance.between(-1, 1), limit.centre - limit.reach,
                               limit.centre + limit.reach);
  double const fastest_s = 1.875 * std::abs(to - path.here()) / limit.speed;
  path.min_jerk(to, std::max(0.18, fastest_s * chance.between(1.0, 3.5)));
  if (chance.uniform() < 0.2) path.rest(chance.between(0.1, 0.7));
}

// to and fro at speeds on a ladder, from creeping to fast
void creep(Path& path, Limits const& limit, Chance& chance, int step) {
  static constexpr double rungs[] = {0.01, 0.02, 0.04, 0.08, 0.15, 0.3, 0.6, 1.0};
  double const speed = limit.speed * rungs[step % 8] * chance.between(0.85, 1.15);
  double const reach = std::min(limit.reach, speed * 0.9);
  path.trapezoid(limit.centre + reach, speed, limit.acceleration * 0.7);
  path.trapezoid(limit.centre - reach, speed, limit.acceleration * 0.7);
  path.trapezoid(limit.centre, speed, limit.acceleration * 0.7);
}

// triangular strokes of growing length, nested: the test for friction before sliding
void micro(Path& path, Limits const& limit, Chance& chance, int step) {
  double const stroke = limit.reach * 0.004 * std::pow(1.8, step % 8) * chance.between(0.8, 1.2);
  double const speed = std::clamp(stroke * 2.5, limit.speed * 0.015, limit.speed * 0.5);
  double const start = path.here();
  path.trapezoid(start + stroke, speed, limit.acceleration);
  path.trapezoid(start - stroke * 0.4, speed, limit.acceleration);
  path.trapezoid(start + stroke * 0.5, speed, limit.acceleration);
  path.trapezoid(start, speed, limit.acceleration);
}

}  // namespace

std::vector<double> make_path(std::string const& kind, Rig const& rig, double tick_s, double duration_s,
                              Chance chance) {
  Limits const limit{rig.centre, rig.half_travel, rig.top_speed, 3 * rig.top_speed * rig.top_speed / rig.half_travel};
  double const hz = rig.top_speed / rig.half_travel / 6.28;  // as slow as the whole travel at top speed
  Path path{tick_s, rig.centre};
  path.rest(0.3);
  for (int step = 0; path.now() < duration_s; ++step) {
    if (kind == "multisine") {
      path.multisine(chance, duration_s - path.now() + 0.1, limit.reach, limit.speed, 0.3 * hz, 7 * hz);
    } else if (kind == "chirp") {
      path.chirp(duration_s / 2, limit.reach * chance.between(0.8, 1), limit.speed, hz / 3, 14 * hz);
      path.chirp(duration_s / 2, limit.reach * chance.between(0.6, 1), limit.speed * 0.7, 11 * hz, hz / 2);
    } else if (kind == "trapezoids") {
      trapezoids(path, limit, chance);
    } else if (kind == "pick_place") {
      pick_place(path, limit, chance, step);
    } else if (kind == "irregular") {
      irregular(path, limit, chance);
    } else if (kind == "creep") {
      creep(path, limit, chance, step);
    } else if (kind == "micro") {
      if (step % 10 < 8) {
        micro(path, limit, chance, step);
      } else {
        trapezoids(path, limit, chance);
      }
    } else if (kind == "mixed") {
      if (step % 3 == 0) path.multisine(chance, duration_s / 5, limit.reach * 0.8, limit.speed, 0.4 * hz, 6 * hz);
      if (step % 3 == 1) {
        for (int rung = 1; rung < 7; rung += 2) creep(path, limit, chance, rung + step % 2);
      }
      if (step % 3 == 2) {
        for (int move = 0; move < 5; ++move) trapezoids(path, limit, chance);
        path.min_jerk(limit.centre, 0.8);
      }
    } else if (kind == "one_speed") {  // nothing but to and fro at one speed
      path.trapezoid(limit.centre + limit.reach * 0.9, limit.speed * 0.35, limit.acceleration * 0.5);
      path.trapezoid(limit.centre - limit.reach * 0.9, limit.speed * 0.35, limit.acceleration * 0.5);
    } else if (kind == "narrow") {  // a tenth of the travel
      path.multisine(chance, duration_s - path.now() + 0.1, limit.reach * 0.1, limit.speed * 0.3, 0.3, 2.0);
    } else {
      throw std::invalid_argument("no motion is called " + kind);
    }
  }
  auto positions = path.positions();
  positions.resize(static_cast<std::size_t>(duration_s / tick_s));
  return positions;
}

}  // namespace stranger
