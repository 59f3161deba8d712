#include "kernels/quadratic_energy.hpp"

#include <algorithm>
#include <cassert>

#include "kernels/dispatch-inl.hpp"
#include "kernels/lane_sum.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/quadratic_energy.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "kernels/fused-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {

// a sum and what its additions and products lost
template <class V>
struct DoubledSum {
  V sum, error;

  // a * b exactly
  HWY_INLINE void add_product(V a, V b) {
    V const product = hn::Mul(a, b);
    V const lost_in_product = fused_mul_add(a, b, hn::Neg(product));
    V const total = hn::Add(sum, product);
    V const back = hn::Sub(total, sum);
    V const lost_in_sum = hn::Add(hn::Sub(sum, hn::Sub(total, back)), hn::Sub(product, back));
    error = hn::Add(error, hn::Add(lost_in_product, lost_in_sum));
    sum = total;
  }
  // a * b is so small that its own rounding does not matter
  HWY_INLINE void add_correction(V a, V b) { error = fused_mul_add(a, b, error); }
};

// members side by side in lanes; high: [r][n_lanes] the members, then members - centre; low: what that lost when it was
// rounded (Knuth's TwoSum); energy: n_lanes
void lanes_energy(QuadraticForm const& form, double* HWY_RESTRICT high, double* HWY_RESTRICT low,
                  double* HWY_RESTRICT energy) {
  hn::CappedTag<double, n_lanes> const d;
  for (std::size_t lane = 0; lane < n_lanes; lane += hn::MaxLanes(d)) {
    for (std::size_t r = 0; r < form.n_regressors; ++r) {
      auto const member = hn::LoadU(d, high + r * n_lanes + lane), centre = hn::Set(d, form.centre[r]);
      auto const step = hn::Sub(member, centre), back = hn::Sub(step, member);
      hn::StoreU(step, d, high + r * n_lanes + lane);
      hn::StoreU(hn::Sub(hn::Sub(member, hn::Sub(step, back)), hn::Add(centre, back)), d, low + r * n_lanes + lane);
    }
    auto squares = hn::Zero(d), slope = hn::Zero(d);
    for (std::size_t i = 0; i < form.n_regressors; ++i) {
      DoubledSum<hn::Vec<decltype(d)>> row{hn::Zero(d), hn::Zero(d)};
      for (std::size_t j = i; j < form.n_regressors; ++j) {
        auto const root = hn::Set(d, form.root[i * form.n_regressors + j]);
        auto const step = hn::LoadU(d, high + j * n_lanes + lane);
        row.add_product(root, step);
        row.add_correction(root, hn::LoadU(d, low + j * n_lanes + lane));
        row.add_correction(hn::Set(d, form.root_low[i * form.n_regressors + j]), step);
      }
      auto const sum = hn::Add(row.sum, row.error);
      squares = fused_mul_add(sum, sum, squares);
    }
    for (std::size_t j = 0; j < form.n_regressors; ++j)
      slope = fused_mul_add(hn::Set(d, form.slope[j]), hn::LoadU(d, high + j * n_lanes + lane), slope);
    auto const above = fused_neg_mul_add(hn::Set(d, 2.0), slope, squares);
    hn::StoreU(hn::Add(hn::Set(d, form.constant), above), d, energy + lane);
  }
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {

TORQUESCOPE_EXPORT(lanes_energy);

}  // namespace

std::size_t quadratic_workspace_size(std::size_t n_regressors) { return (2 * n_regressors + 1) * n_lanes; }

void quadratic_energy(QuadraticForm const& form, Candidates const& candidates, double* energy, double* workspace) {
  assert(candidates.n_members == 0 || candidates.leading_dimension >= form.n_regressors);
  auto const evaluate = TORQUESCOPE_DISPATCH(lanes_energy);
  double* const high = workspace;
  double* const low = high + form.n_regressors * n_lanes;
  double* const lanes = low + form.n_regressors * n_lanes;
  for (std::size_t first = 0; first < candidates.n_members; first += n_lanes) {
    std::size_t const count = std::min(n_lanes, candidates.n_members - first);
    for (std::size_t lane = 0; lane < n_lanes; ++lane) {
      // lanes without a member repeat the last one
      double const* const member = candidates.data + (first + std::min(lane, count - 1)) * candidates.leading_dimension;
      for (std::size_t r = 0; r < form.n_regressors; ++r) high[r * n_lanes + lane] = member[r];
    }
    evaluate(form, high, low, lanes);
    std::copy_n(lanes, count, energy + first);
  }
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
