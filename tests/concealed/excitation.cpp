#include "concealed/excitation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "concealed/noise.hpp"

namespace concealed {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double fade_s = 1.0;       // multisine in and out
constexpr double speed_up_s = 0.15;  // from rest to peak speed

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
    case Recipe::one_speed:
      break;
  }
  return "one_speed";
}

Excitation::Excitation(Recipe recipe, MotionLimits const& limits, double duration_s, std::uint64_t seed)
    : limits_(limits) {
  std::vector<double> const steps = {1.0, 0.7, 0.45, 0.28, 0.16, 0.09, 0.05};
  std::vector<double> const slow = {0.07, 0.045, 0.028, 0.018, 0.012, 0.008};
  dwell(0.3);
  // until the time is up or no kind of piece fits any more
  int without_piece = 0;
  for (std::uint64_t turn = 0; without_piece < 3 && end_time() < duration_s - 2.0 * fade_s; ++turn) {
    double const before = end_time(), left = duration_s - before;
    std::uint64_t const piece_seed = seed + 1000003 * turn;
    switch (recipe) {
      case Recipe::multisine:
        add_multisine(left, piece_seed);
        break;
      case Recipe::staircase:
        add_strokes(left, limits.range, steps, piece_seed);
        break;
      case Recipe::creep:
        add_strokes(left, 0.08 * limits.range, slow, piece_seed);
        break;
      case Recipe::one_speed:
        add_strokes(left, 0.5 * limits.range, {0.4}, piece_seed);
        break;
      case Recipe::mixed:
        switch (turn % 3) {
          case 0:
            add_multisine(std::min(left, 9.0), piece_seed);
            break;
          case 1:
            add_strokes(std::min(left, 14.0), limits.range, steps, piece_seed);
            break;
          default:
            add_strokes(std::min(left, 8.0), 0.04 * limits.range, slow, piece_seed);
            break;
        }
    }
    without_piece = end_time() > before ? 0 : without_piece + 1;
  }
}

double Excitation::end_time() const {
  return stretches_.empty() ? 0.0 : stretches_.back().start + stretches_.back().length;
}

void Excitation::add_multisine(double length, std::uint64_t seed) {
  Random random(seed, "multisine");
  Stretch piece{end_time(), length, 0.0, 0.0, 0.0, {}};
  // log-spaced frequencies; equal speed amplitude each, phases at random
  int const n_sines = 9;
  double const lowest_hz = 0.13, highest_hz = 2.1;
  for (int i = 0; i < n_sines; ++i) {
    double const hz = lowest_hz * std::pow(highest_hz / lowest_hz, (i + 0.5 * random.uniform()) / (n_sines - 0.5));
    piece.sines.push_back({1.0 / (two_pi * hz), two_pi * hz, two_pi * random.uniform()});
  }
  // scaled to the first limit it meets
  double peak_q = 0.0, peak_v = 0.0, last = 0.0;
  double const look_s = 0.005;
  for (double t = look_s; t < length; t += look_s) {
    double q = 0.0;
    for (auto const& sine : piece.sines) q += sine.amplitude * std::sin(sine.omega * t + sine.phase);
    q *= fade(t, length);
    peak_q = std::max(peak_q, std::abs(q));
    peak_v = std::max(peak_v, std::abs(q - last) / look_s);
    last = q;
  }
  double const scale = std::min(limits_.range / peak_q, limits_.speed / peak_v);
  for (auto& sine : piece.sines) sine.amplitude *= scale;
  stretches_.push_back(std::move(piece));
  here_ = 0.0;
}

void Excitation::dwell(double length) { stretches_.push_back({end_time(), length, here_, 0.0, 0.0, {}}); }

void Excitation::stroke_to(double target, double speed) {
  double const way = std::abs(target - here_);
  double const side = target > here_ ? 1.0 : -1.0;
  double const a = limits_.speed / speed_up_s;
  double const v = std::min(speed, std::sqrt(a * way));
  double const up_s = v / a, cruise_s = std::max(0.0, way / v - up_s);
  double const up_way = 0.5 * v * up_s;
  stretches_.push_back({end_time(), up_s, here_, 0.0, side * a, {}});
  stretches_.push_back({end_time(), cruise_s, here_ + side * up_way, side * v, 0.0, {}});
  stretches_.push_back({end_time(), up_s, target - side * up_way, side * v, -side * a, {}});
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
  if (stretch.sines.empty()) return stretch.q + x * (stretch.v + 0.5 * stretch.a * x);
  double q = 0.0;
  for (auto const& sine : stretch.sines) q += sine.amplitude * std::sin(sine.omega * x + sine.phase);
  return fade(x, stretch.length) * q;
}

}  // namespace concealed
