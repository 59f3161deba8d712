#pragma once
// Cut-offs and decimation that suit a recording: what `torquescope init` writes.
//
// Motion     f_m, below which 98 % of the energy of the velocity lie; r reversals a second
// Noise      f_n, the highest cut-off at which the noise of the position, differentiated twice, stays below a fifth of
//            the acceleration: var = sigma^2 (2 pi)^4 (2 f^5 / 5) / f_s of white noise sigma
// Equation   cutoff_hz = min(10 f_m, f_n), at least f_s / 12 or 20 Hz, and 12.8 r as far as 2 f_n (then at most half of
//            the time is masked, pipeline/reversal_mask.hpp), at most f_s / 5 (of a slow source, its own); half
//            of it parallel; decimate_to_hz = f_s / k: 2.5 to 4 times that, or 1000 rows; edges drop at most a fifth
// Arms       f_m: 99.9 % of the energy of all positions together, which ripple and lost samples hardly change; rows
//            near a reversal are left out, where friction is faster than the motion: no f_s / 12, no 20 Hz
// Threads    free function
// Source     `torquescope describe filter`

#include <span>

#include "engine/data/motion.hpp"

namespace torquescope {

struct FilterSuggestion {
  FilterOptions options{};
  double motion_hz = 0.0;  // f_m
  double noise_hz = 0.0;   // f_n; 0: the position has no noise to see
  enum class Limit { motion, noise, rate, slow_motion, reversals, length } limit = Limit::motion;  // what decided
};

// shortest_s: of all recordings that the filter is for
FilterSuggestion suggest_filter(Recording const& recording, double shortest_s);

// joints: of one recording, all in rad or all in m; noise_hz is that of the clearest, reversals those of the busiest
FilterSuggestion suggest_arm_filter(std::span<Recording const> joints, double shortest_s);

// decimate_to_hz for a parallel cut-off: rate_hz / k between 2.5 and 4 times it, with the fewest digits; 0 when k = 1.
// seconds: of a recording that shall keep the 1000 rows that a search wants; 0: as many as there are
double suggested_kept_rate(double rate_hz, double parallel_cutoff_hz, double seconds = 0.0);

}  // namespace torquescope
