#pragma once
// Reference motions, put together from pieces that begin and end at rest at position 0.
//
// Pieces     multisine        Schroeder-like phases, faded in and out within a second
//            staircase        trapezoidal strokes over the same range, a different speed each, both directions, dwells
//            creep            the same at speeds from 0.8 % to 7 % over a small range
// Recipes    multisine, staircase, creep: one kind until the time is up;  mixed: all three in turn;
//            one_speed: staircase at one speed, so that laws of the velocity cannot be told apart
// Units      s; rad or m

#include <cstdint>
#include <string>
#include <vector>

namespace concealed {

enum class Recipe { multisine, staircase, creep, mixed, one_speed };
std::string to_text(Recipe recipe);

struct MotionLimits {
  double range = 0.0;  // the motion stays within -range ... range
  double speed = 0.0;  // peak speed
};

class Excitation {
 public:
  Excitation(Recipe recipe, MotionLimits const& limits, double duration_s, std::uint64_t seed);
  double position(double t) const;  // 0 before the start and after the last piece that fits

 private:
  struct Sine {
    double amplitude, omega, phase;
  };
  // one stretch of time: parabola from (q, v) with constant acceleration, or a multisine when sines are given
  struct Stretch {
    double start, length, q, v, a;
    std::vector<Sine> sines;
  };
  double end_time() const;
  void add_multisine(double length, std::uint64_t seed);
  void stroke_to(double target, double speed);
  void dwell(double length);
  void add_strokes(double length, double range, std::vector<double> speeds, std::uint64_t seed);

  MotionLimits limits_;
  std::vector<Stretch> stretches_;
  double here_ = 0.0;  // where the last stretch ends
};

}  // namespace concealed
