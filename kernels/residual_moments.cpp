#include "kernels/residual_moments.hpp"

#include <cmath>
#include <cstddef>

#include "kernels/dispatch-inl.hpp"
#include "kernels/lane_sum.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/residual_moments.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "kernels/double_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {
namespace {

struct Lanes {
  V part[n_vectors];

  HWY_INLINE void clear() {
    for (auto& vector : part) vector = hn::Zero(d);
  }
  HWY_INLINE void store(double* lane) const {
    for (std::size_t v = 0; v < n_vectors; ++v) hn::StoreU(part[v], d, lane + v * vector_lanes);
  }
};

template <std::size_t count>
HWY_INLINE void sums_of(SampleColumns const& samples, double const* parameters, double* residuals, ResidualSums* sums) {
  std::size_t const n = samples.n_samples, R = samples.n_regressors, whole = n / n_lanes * n_lanes;
  Lanes sum[count], squares[count];
  for (std::size_t c = 0; c < count; ++c) {
    sum[c].clear();
    squares[c].clear();
  }
  for (std::size_t row = 0; row < whole; row += n_lanes) {
    for (std::size_t v = 0; v < n_vectors; ++v) {
      std::size_t const from = row + v * vector_lanes;
      V residual[count];
      V const torque = hn::LoadU(d, samples.tau + from);
      for (std::size_t c = 0; c < count; ++c) residual[c] = torque;
      for (std::size_t r = 0; r < R; ++r) {
        V const column = hn::LoadU(d, samples.phi + r * samples.leading_dimension + from);
        for (std::size_t c = 0; c < count; ++c)
          residual[c] = fused_neg_mul_add(column, hn::Set(d, parameters[c * R + r]), residual[c]);
      }
      for (std::size_t c = 0; c < count; ++c) {
        hn::StoreU(residual[c], d, residuals + c * n + from);
        sum[c].part[v] = hn::Add(sum[c].part[v], residual[c]);
        squares[c].part[v] = fused_mul_add(residual[c], residual[c], squares[c].part[v]);
      }
    }
  }
  for (std::size_t c = 0; c < count; ++c) {
    double of_sum[n_lanes], of_squares[n_lanes];
    sum[c].store(of_sum);
    squares[c].store(of_squares);
    for (std::size_t row = whole; row < n; ++row) {
      double residual = samples.tau[row];
      for (std::size_t r = 0; r < R; ++r)
        residual = std::fma(-samples.phi[row + r * samples.leading_dimension], parameters[c * R + r], residual);
      residuals[c * n + row] = residual;
      of_sum[row - whole] += residual;
      of_squares[row - whole] = std::fma(residual, residual, of_squares[row - whole]);
    }
    sums[c] = {sum_lanes(of_sum), sum_lanes(of_squares)};
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
  std::size_t const whole = n / n_lanes * n_lanes;
  V const middle = hn::Set(d, centre);
  Lanes squares;
  squares.clear();
  for (std::size_t row = 0; row < whole; row += n_lanes)
    for (std::size_t v = 0; v < n_vectors; ++v) {
      V const apart = hn::Sub(hn::LoadU(d, residuals + row + v * vector_lanes), middle);
      squares.part[v] = fused_mul_add(apart, apart, squares.part[v]);
    }
  double lane[n_lanes];
  squares.store(lane);
  for (std::size_t row = whole; row < n; ++row) {
    double const apart = residuals[row] - centre;
    lane[row - whole] = std::fma(apart, apart, lane[row - whole]);
  }
  return sum_lanes(lane);
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
