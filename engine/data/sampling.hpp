#pragma once
// What the time stamps of a recording say: backwards, repeated, missing, jittered, or even as far as they are printed.
//
// Rate       the median step's, taken as the roundest number the stamps allow (within 0.5 % when they jitter)
// Even       no stamp is further from an even grid than 2 % of a step, or than the stamps' printed digits explain. Less
//            than that is mostly the clock of the log, not of the loop: samples moved by it obey their controller no
//            more
// Repeats    a row whose stamp equals the one before is dropped, unless coarse printing of an even clock explains it
// Gaps       more than 10 steps without a row: their ends are in `gaps`, and nobody knows what lies between
// Errors     Error 65: time runs backwards or stands still, half of the recording's time has no rows

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
  std::vector<Stretch> gaps{};    // s since the first row
};

// stamp_unit_s: the spacing that the stamps had before they became seconds since the first row, where that is known
Sampling analyse_sampling(std::vector<double> const& stamps_s, RawTable const& table, double stamp_unit_s = 0.0);
// the spacing of numbers of single precision as large as the stamps, where all of them are such numbers, or were before
// they were printed; else 0
double single_precision_unit(std::vector<double> const& stamps);
// a file without time column
Sampling sampling_at(double rate_hz, std::size_t n_rows);

// the number with the fewest digits within `tolerance` (relative) of `value`
double roundest(double value, double tolerance);

}  // namespace torquescope
