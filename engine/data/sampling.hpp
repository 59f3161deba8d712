#pragma once
// What the time stamps of a recording say: backwards, repeated, missing, jittered, or even as far as they are printed.
//
// Rate       the median step's, taken as the roundest number the stamps allow (within 0.5 % when they jitter)
// Even       no stamp is further from an even grid than 2 % of a step, or than the stamps' printed digits explain. Less
//            than that is mostly the clock of the log, not of the loop: samples moved by it obey their controller no
//            more
// Repeats    a row whose stamp equals the one before is dropped, unless coarse printing of an even clock explains it
// Errors     Error 65: time runs backwards or stands still, steps of half a second and more (counts or milliseconds),
//            a gap of more than 10 steps

#include <cstddef>
#include <vector>

#include "engine/data/recording_reader.hpp"

namespace torquescope {

inline constexpr double largest_gap_steps = 10.0;

struct Sampling {
  double rate_hz = 0.0;
  bool even = true;
  std::vector<double> times;      // s since the first row; of the rows kept; on the grid when even
  std::vector<std::size_t> rows;  // rows kept: all but repeats
  RowFacts facts{};               // jitter, repeated, missing
};

Sampling analyse_sampling(std::vector<double> const& stamps_s, RawTable const& table);
// a file without time column
Sampling sampling_at(double rate_hz, std::size_t n_rows);

// the number with the fewest digits within `tolerance` (relative) of `value`
double roundest(double value, double tolerance);

}  // namespace torquescope
