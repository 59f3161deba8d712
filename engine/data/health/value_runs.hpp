#pragma once
// Runs of equal values of a signal, and whether they come from a source that is slower than its log.
//
// Equation   L_k rows from one change to the next; T the mean of those up to 1.5 T or T + 1, from their median on. A
//            run of more than 1.75 T rows is round(L / T) samples of the source, evenly: a joint may rest
// Slow       T >= 1.75 rows, hardly a run is shorter than T / 2, and the changes are no single steps of an encoder or
//            lie on a grid of whole rows: a coarse encoder that moves slowly repeats too, and changes by one step
// Shapes     values: one per row, all numbers
// Threads    free function

#include <cstddef>
#include <span>
#include <vector>

namespace torquescope {

struct SlowSource {
  double rows = 1.0;                   // from one sample of the source to the next, on average
  std::vector<std::size_t> samples{};  // rows at which a value was new; empty: not slow
  bool is_slow() const { return !samples.empty(); }
};

SlowSource slow_source_of(std::span<double const> values);

}  // namespace torquescope
