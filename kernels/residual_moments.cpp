#include "kernels/residual_moments.hpp"

#include <algorithm>
#include <cstddef>

#include "kernels/dispatch-inl.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/residual_moments.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

inline constexpr std::size_t stride = 4;  // rows that a sum keeps apart
using D = hn::CappedTag<double, stride>;
using V = hn::Vec<D>;
inline constexpr D d;
inline constexpr std::size_t vector_lanes = hn::MaxLanes(d);
inline constexpr std::size_t n_vectors = stride / vector_lanes;

struct Apart {
  V lanes[n_vectors];

  HWY_INLINE void clear() {
    for (auto& vector : lanes) vector = hn::Zero(d);
  }
  // of the whole groups of rows; `rest`: the rows behind them, fewer than four
  HWY_INLINE double total(double const* rest, std::size_t n_rest, bool has_groups) const {
    double apart[stride];
    for (std::size_t v = 0; v < n_vectors; ++v) hn::StoreU(lanes[v], d, apart + v * vector_lanes);
    double even = apart[0] + apart[2], odd = apart[1] + apart[3];
    if (n_rest >= 2) {
      even = has_groups ? even + rest[0] : rest[0];
      odd = has_groups ? odd + rest[1] : rest[1];
    }
    double const both = even + odd;
    if (n_rest % 2 == 0) return both;
    return has_groups || n_rest == 3 ? both + rest[n_rest - 1] : rest[0];
  }
};

template <std::size_t count>
HWY_INLINE void sums_of(SampleColumns const& samples, double const* parameters, double* residuals, ResidualSums* sums) {
  std::size_t const n = samples.n_samples, R = samples.n_regressors, whole = n / stride * stride;
  Apart sum[count], squares[count];
  for (std::size_t c = 0; c < count; ++c) {
    sum[c].clear();
    squares[c].clear();
  }
  for (std::size_t row = 0; row < whole; row += stride) {
    for (std::size_t v = 0; v < n_vectors; ++v) {
      double const* const phi = samples.phi + row + v * vector_lanes;
      V predicted[count];
      V const first = hn::LoadU(d, phi);
      for (std::size_t c = 0; c < count; ++c) predicted[c] = hn::Mul(first, hn::Set(d, parameters[c * R]));
      for (std::size_t r = 1; r < R; ++r) {
        V const column = hn::LoadU(d, phi + r * samples.leading_dimension);
        for (std::size_t c = 0; c < count; ++c)
          predicted[c] = hn::Add(hn::Mul(column, hn::Set(d, parameters[c * R + r])), predicted[c]);
      }
      V const torque = hn::LoadU(d, samples.tau + row + v * vector_lanes);
      for (std::size_t c = 0; c < count; ++c) {
        V const residual = hn::Sub(torque, predicted[c]);
        hn::StoreU(residual, d, residuals + c * n + row + v * vector_lanes);
        sum[c].lanes[v] = hn::Add(sum[c].lanes[v], residual);
        squares[c].lanes[v] = hn::Add(squares[c].lanes[v], hn::Mul(residual, residual));
      }
    }
  }
  for (std::size_t c = 0; c < count; ++c) {
    double square[stride] = {};
    double* const rest = residuals + c * n + whole;
    for (std::size_t row = whole; row < n; ++row) {
      double predicted = samples.phi[row] * parameters[c * R];
      for (std::size_t r = 1; r < R; ++r)
        predicted = samples.phi[row + r * samples.leading_dimension] * parameters[c * R + r] + predicted;
      rest[row - whole] = samples.tau[row] - predicted;
      square[row - whole] = rest[row - whole] * rest[row - whole];
    }
    sums[c] = {sum[c].total(rest, n - whole, whole > 0), squares[c].total(square, n - whole, whole > 0)};
  }
}

}  // namespace

void all_sums(SampleColumns const& samples, double const* parameters, std::size_t n_candidates, double* residuals,
              ResidualSums* sums) {
  constexpr std::size_t together = 4;
  std::size_t const R = samples.n_regressors, n = samples.n_samples;
  std::size_t c = 0;
  for (; c + together <= n_candidates; c += together)
    sums_of<together>(samples, parameters + c * R, residuals + c * n, sums + c);
  for (; c < n_candidates; ++c) sums_of<1>(samples, parameters + c * R, residuals + c * n, sums + c);
}

double all_squares_about(double const* residuals, std::size_t n, double centre) {
  std::size_t const whole = n / stride * stride;
  V const middle = hn::Set(d, centre);
  Apart squares;
  squares.clear();
  for (std::size_t row = 0; row < whole; row += stride)
    for (std::size_t v = 0; v < n_vectors; ++v) {
      V const apart = hn::Sub(hn::LoadU(d, residuals + row + v * vector_lanes), middle);
      squares.lanes[v] = hn::Add(squares.lanes[v], hn::Mul(apart, apart));
    }
  double square[stride] = {};
  for (std::size_t row = whole; row < n; ++row)
    square[row - whole] = (residuals[row] - centre) * (residuals[row] - centre);
  return squares.total(square, n - whole, whole > 0);
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {

TORQUESCOPE_EXPORT(all_sums);
TORQUESCOPE_EXPORT(all_squares_about);

}  // namespace

void residual_sums(SampleColumns const& samples, double const* parameters, std::size_t n_candidates, double* residuals,
                   ResidualSums* sums) {
  TORQUESCOPE_DISPATCH(all_sums)(samples, parameters, n_candidates, residuals, sums);
}

double squares_about(double const* residuals, std::size_t n_samples, double centre) {
  return TORQUESCOPE_DISPATCH(all_squares_about)(residuals, n_samples, centre);
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
