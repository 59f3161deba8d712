#pragma once
// Reference motions, put together from pieces that begin and end at rest, most of them at position 0.
//
// Pieces     multisine        Schroeder-like phases, faded in and out within a second
//            staircase        trapezoidal strokes over the same range, a different speed each, both directions, dwells
//            creep            the same at speeds from 0.8 % to 7 % over a small range
// Recipes    multisine, staircase, creep: one kind until the time is up;  mixed: all three in turn;
//            chirp: sweeps from 0.15 to 2.5 Hz;  pick_and_place: a cycle of four poses, each approached slowly;
//            everyday: smooth moves of any length and speed with rests, as a machine at work makes them
// Weak       one_speed: staircase at one speed;  narrow: multisine over a twentieth of the range;
//            one_direction: turns on without end, at different speeds: laws that they cannot tell apart stay apart
// Units      s; rad or m

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace concealed {

enum class Recipe {
  multisine,
  staircase,
  creep,
  mixed,
  chirp,
  pick_and_place,
  everyday,
  one_speed,
  narrow,
  one_direction
};
std::string to_text(Recipe recipe);

inline constexpr double speed_up_s = 0.15;  // from rest to peak speed

struct MotionLimits {
  double range = 0.0;  // the motion stays within -range ... range
  double speed = 0.0;  // peak speed
};

class Excitation {
 public:
  Excitation(Recipe recipe, MotionLimits const& limits, double duration_s, std::uint64_t seed);
  double position(double t) const;  // 0 before the start and after the last piece that fits

 private:
  using Shape = std::function<double(double)>;  // position by the time since the stretch began
  struct Stretch {
    double start, length;
    Shape shape;
  };
  double end_time() const;
  void add(double length, Shape shape) { stretches_.push_back({end_time(), length, std::move(shape)}); }
  void add_piece(Recipe recipe, double duration_s, std::uint64_t turn, std::uint64_t seed);
  // constant acceleration from (q, v)
  void add_parabola(double length, double q, double v, double a);
  // faded in and out; the scale with which a shape meets the first of its limits
  double scale_to_limits(double length, Shape const& shape) const;
  void add_faded(double length, Shape const& shape);
  void add_multisine(double length, std::uint64_t seed);
  void add_chirp(double length);
  void stroke_to(double target, double speed);
  void glide_to(double target, double speed);  // without jumps of the acceleration
  void dwell(double length);
  void add_strokes(double length, double range, std::vector<double> speeds, std::uint64_t seed);
  void add_cycles(double length, std::uint64_t seed);
  void add_errands(double length, std::uint64_t seed);
  void add_turning(double length, std::uint64_t seed);

  MotionLimits limits_;
  std::vector<Stretch> stretches_;
  double here_ = 0.0;  // where the last stretch ends
};

}  // namespace concealed
