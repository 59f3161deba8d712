// Strokes between centre - amplitude and centre + amplitude with a trapezoidal velocity profile, forth and back at each
// of the given speeds in turn: constant speeds in both directions over the same positions separate viscous from dry
// friction.
//
// Profile    accelerate at max_acceleration, cruise, brake at the same rate, dwell; a stroke too short for its speed
//            has no cruise and peaks below it
// Start      at the centre; the first stroke leads to centre - amplitude

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/simulate/references/reference_choice.hpp"

namespace torquescope {

namespace {

// motion of constant acceleration from `begin_s` on
struct Piece {
  double begin_s;
  ReferencePoint begin;
};

class Trapezoid : public Reference {
 public:
  explicit Trapezoid(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}

  ReferencePoint at(double time_s) const override {
    auto const later = std::upper_bound(pieces_.begin(), pieces_.end(), time_s,
                                        [](double time, Piece const& piece) { return time < piece.begin_s; });
    Piece const& piece = later == pieces_.begin() ? *later : *(later - 1);
    double const elapsed = std::max(time_s - piece.begin_s, 0.0);
    ReferencePoint const& begin = piece.begin;
    return {begin.q + (begin.dq + 0.5 * begin.ddq * elapsed) * elapsed, begin.dq + begin.ddq * elapsed, begin.ddq};
  }

 private:
  std::vector<Piece> pieces_;
};

// one stroke from rest at `from` to rest at `to`, and the dwell there; returns the time after it
double add_stroke(std::vector<Piece>& pieces, double begin_s, double from, double to, double speed,
                  ReferenceOptions const& options) {
  double const direction = to > from ? 1.0 : -1.0;
  double const length = std::abs(to - from);
  double const a = options.max_acceleration;
  double const v = std::min(speed, std::sqrt(length * a));
  double const ramp_s = v / a;
  double const cruise_s = length / v - ramp_s;
  double const ramp_length = 0.5 * v * ramp_s;

  pieces.push_back({begin_s, {from, 0.0, direction * a}});
  pieces.push_back({begin_s + ramp_s, {from + direction * ramp_length, direction * v, 0.0}});
  pieces.push_back({begin_s + ramp_s + cruise_s, {to - direction * ramp_length, direction * v, -direction * a}});
  double const arrival_s = begin_s + 2.0 * ramp_s + cruise_s;
  pieces.push_back({arrival_s, {to, 0.0, 0.0}});
  return arrival_s + options.dwell_s;
}

}  // namespace

std::unique_ptr<Reference const> make_trapezoid(ReferenceOptions const& options, double duration_s, RandomKey const&) {
  double const low = options.centre - options.amplitude;
  double const high = options.centre + options.amplitude;
  std::vector<Piece> pieces;
  double time_s = add_stroke(pieces, 0.0, options.centre, low, options.speeds.front(), options);
  while (time_s < duration_s) {
    for (double const speed : options.speeds) {
      time_s = add_stroke(pieces, time_s, low, high, speed, options);
      time_s = add_stroke(pieces, time_s, high, low, speed, options);
    }
  }
  return std::make_unique<Trapezoid>(std::move(pieces));
}

}  // namespace torquescope
