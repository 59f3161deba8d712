#include "concealed/excitation.hpp"

#include <algorithm>
#include <cmath>

#include "concealed/noise.hpp"
#include "concealed/one_turn.hpp"

namespace concealed {
namespace {

constexpr double fade_s = 1.0;  // multisine in and out

double fade(double t, double length) {
  double const edge = std::min({1.0, t / fade_s, (length - t) / fade_s});
  double const x = std::clamp(edge, 0.0, 1.0);
  return x * x * x * (10.0 + x * (-15.0 + 6.0 * x));
}

}  // namespace

std::string to_text(Recipe recipe) {
  switch (recipe) {
    case Recipe::multisine:
      return "multisine";
    case Recipe::staircase:
      return "staircase";
    case Recipe::creep:
      return "creep";
    case Recipe::mixed:
      return "mixed";
    case Recipe::chirp:
      return "chirp";
    case Recipe::pick_and_place:
      return "pick_and_place";
    case Recipe::everyday:
      return "everyday";
    case Recipe::one_speed:
      return "one_speed";
    case Recipe::narrow:
      return "narrow";
    case Recipe::one_direction:
      break;
  }
  return "one_direction";
}

Excitation::Excitation(Recipe recipe, MotionLimits const& limits, double duration_s, std::uint64_t seed)
    : limits_(limits) {
  if (recipe == Recipe::narrow) limits_.range *= 0.05;
  dwell(0.3);
  // until the time is up or no kind of piece fits any more
  int without_piece = 0;
  for (std::uint64_t turn = 0; without_piece < 3 && end_time() < duration_s - 2.0 * fade_s; ++turn) {
    double const before = end_time();
    add_piece(recipe, duration_s - before, turn, seed + 1000003 * turn);
    without_piece = end_time() > before ? 0 : without_piece + 1;
  }
}

void Excitation::add_piece(Recipe recipe, double left, std::uint64_t turn, std::uint64_t seed) {
  std::vector<double> const steps = {1.0, 0.7, 0.45, 0.28, 0.16, 0.09, 0.05};
  std::vector<double> const slow = {0.07, 0.045, 0.028, 0.018, 0.012, 0.008};
  switch (recipe) {
    case Recipe::multisine:
    case Recipe::narrow:
      return add_multisine(left, seed);
    case Recipe::staircase:
      return add_strokes(left, limits_.range, steps, seed);
    case Recipe::creep:
      return add_strokes(left, 0.08 * limits_.range, slow, seed);
    case Recipe::one_speed:
      return add_strokes(left, 0.5 * limits_.range, {0.4}, seed);
    case Recipe::chirp:
      return add_chirp(std::min(left, 20.0));
    case Recipe::pick_and_place:
      return add_cycles(left, seed);
    case Recipe::everyday:
      return add_errands(left, seed);
    case Recipe::one_direction:
      return add_turning(left, seed);
    case Recipe::mixed:
      break;
  }
  if (turn % 3 == 0) return add_multisine(std::min(left, 9.0), seed);
  if (turn % 3 == 1) return add_strokes(std::min(left, 14.0), limits_.range, steps, seed);
  add_strokes(std::min(left, 8.0), 0.04 * limits_.range, slow, seed);
}

double Excitation::end_time() const {
  return stretches_.empty() ? 0.0 : stretches_.back().start + stretches_.back().length;
}

double Excitation::scale_to_limits(double length, Shape const& shape) const {
  double peak_q = 0.0, peak_v = 0.0, last = 0.0;
  double const look_s = 0.005;
  for (double t = look_s; t < length; t += look_s) {
    double const q = fade(t, length) * shape(t);
    peak_q = std::max(peak_q, std::abs(q));
    peak_v = std::max(peak_v, std::abs(q - last) / look_s);
    last = q;
  }
  return std::min(limits_.range / peak_q, limits_.speed / peak_v);
}

void Excitation::add_faded(double length, Shape const& shape) {
  add(length, [=](double t) { return fade(t, length) * shape(t); });
  here_ = 0.0;
}

void Excitation::add_multisine(double length, std::uint64_t seed) {
  Random random(seed, "multisine");
  struct Sine {
    double amplitude, omega, phase;
  };
  std::vector<Sine> sines;
  // log-spaced frequencies; equal speed amplitude each, phases at random
  int const n_sines = 9;
  double const lowest_hz = 0.13, highest_hz = 2.1;
  for (int i = 0; i < n_sines; ++i) {
    double const hz = lowest_hz * std::pow(highest_hz / lowest_hz, (i + 0.5 * random.uniform()) / (n_sines - 0.5));
    sines.push_back({1.0 / (one_turn * hz), one_turn * hz, one_turn * random.uniform()});
  }
  auto sum_of = [](std::vector<Sine> const& all) -> Shape {
    return [all](double t) {
      double q = 0.0;
      for (auto const& sine : all) q += sine.amplitude * std::sin(sine.omega * t + sine.phase);
      return q;
    };
  };
  double const scale = scale_to_limits(length, sum_of(sines));
  for (auto& sine : sines) sine.amplitude *= scale;
  add_faded(length, sum_of(sines));
}

void Excitation::add_parabola(double length, double q, double v, double a) {
  add(length, [=](double x) { return q + x * (v + 0.5 * a * x); });
}

void Excitation::dwell(double length) { add_parabola(length, here_, 0.0, 0.0); }

void Excitation::stroke_to(double target, double speed) {
  double const way = std::abs(target - here_);
  double const side = target > here_ ? 1.0 : -1.0;
  double const a = limits_.speed / speed_up_s;
  double const v = std::min(speed, std::sqrt(a * way));
  double const up_s = v / a, cruise_s = std::max(0.0, way / v - up_s);
  double const up_way = 0.5 * v * up_s;
  add_parabola(up_s, here_, 0.0, side * a);
  add_parabola(cruise_s, here_ + side * up_way, side * v, 0.0);
  add_parabola(up_s, target - side * up_way, side * v, -side * a);
  here_ = target;
}

void Excitation::add_strokes(double length, double range, std::vector<double> speeds, std::uint64_t seed) {
  Random random(seed, "strokes");
  double const stop = end_time() + length;
  double const longest_dwell_s = 0.2;
  std::size_t too_long = 0;  // speeds in a row that did not fit any more
  for (std::size_t n = 0; too_long < speeds.size(); ++n) {
    // every speed once in a new order, then all again: speeds are interleaved in time
    std::size_t const round = n % speeds.size();
    std::swap(speeds[round], speeds[round + random.index(speeds.size() - round)]);
    double const speed = speeds[round] * limits_.speed;
    // a slow stroke is a short one: no speed takes more than a fifth of the time at once
    double const far = std::min(range, speed * length / 20.0);
    double const there_and_back_s = 4.0 * far / speed + 3.0 * speed_up_s + 2.0 * longest_dwell_s + 0.05;
    if (end_time() + there_and_back_s > stop) {
      ++too_long;
      continue;
    }
    too_long = 0;
    stroke_to(far, speed);
    dwell(random.between(0.05, longest_dwell_s));
    stroke_to(-far, speed);
    dwell(random.between(0.05, longest_dwell_s));
    stroke_to(0.0, speed);
    dwell(0.05);
  }
}

double Excitation::position(double t) const {
  auto const after = std::upper_bound(stretches_.begin(), stretches_.end(), t,
                                      [](double time, Stretch const& stretch) { return time < stretch.start; });
  if (after == stretches_.begin()) return 0.0;
  Stretch const& stretch = *std::prev(after);
  double const x = t - stretch.start;
  if (x > stretch.length) return here_;
  return stretch.shape(x);
}

}  // namespace concealed
