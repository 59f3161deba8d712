#pragma once
// Goals of a recording at its samples, and whether the drive is on.

#include <cstdint>
#include <string>
#include <vector>

namespace servo {

enum class Kind { two_sines, up_and_down, steps, lift_and_drop, growing_sine };
constexpr int n_kinds = 5;
std::string to_text(Kind kind);

struct Sample {
  double time = 0.0, goal = 0.0;  // the goal as it is logged, four decimals
  bool is_on = true;
};

// jitter_s: greatest error of a sample's time, which is a whole number of steps; 0: an even clock
struct MotionOptions {
  std::uint64_t seed = 1;
  double duration_s = 6.0, jitter_s = 0.0;
};

// number: 0, 1, ...: kinds take turns, and each number is another draw. recording: of its clock
std::vector<Sample> draw_motion(MotionOptions const& options, int number, std::uint64_t recording);

}  // namespace servo
