#pragma once
// What the past of a signal does not tell about it: every sample less a weighted sum of those before it, in place.
//
// Equation   x_k <- gain (x_k - sum_i past_i x_(k-1-i)), i = 0 .. order - 1, with x as it was before the call on the
//            right
// Sum        in four parts, part j of i = j mod 4, which (s0 + s1) + (s2 + s3) joins; what is left of order beyond a
//            multiple of four goes to s0
// Shapes     x: n_samples to change, after `order` more that are only read (x[-order] .. x[-1])
// Bits       the same on every instruction set and for any n_samples: no operation is fused, each sample is its own
//            lane
// Threads    free function; does not allocate

#include <cstddef>
#include <vector>

namespace torquescope::kernels {

void take_prediction_errors(double const* past, std::size_t order, double gain, double* x, std::size_t n_samples);

// The same for the samples at the beginning of a stretch: sample m has only m before it, and its own weights of those.
//
// Equation   x_m <- gain_m (x_m - sum_i past_mi x_(m-1-i)), i = 0 .. m - 1; sums as above
// Shapes     past: of m = 0, 1, ... as many as there are samples with weights of their own, past[m].size() == m; gain
//            alike
// Requires   finite x: what is not there counts as zero times zero
// Threads    const object, any number of threads; take() allocates
class FirstPredictionErrors {
 public:
  FirstPredictionErrors() = default;
  FirstPredictionErrors(std::vector<std::vector<double>> const& past, std::vector<double> const& gain);
  // of the first n_samples of a stretch, at most as many as were told
  void take(double* x, std::size_t n_samples) const;

 private:
  std::vector<double> weights_{};  // of eight neighbouring samples side by side, in the order they are asked for
  std::vector<double> gain_{};     // whole eights
};

}  // namespace torquescope::kernels
