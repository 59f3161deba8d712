#include "kernels/quadratic_energy.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>

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

// Vectors of members that go side by side: one alone waits for its own sums.
inline constexpr std::size_t vectors = 2;

// energies of as many members as the vectors have lanes: those from candidates on whose places are in `place`
template <class Reals, class Place>
HWY_INLINE void lanes_energy(QuadraticForm const& form, double const* HWY_RESTRICT candidates, Place const* place,
                             double* HWY_RESTRICT high, double* HWY_RESTRICT low, double* HWY_RESTRICT energy) {
  using V = hn::Vec<Reals>;
  constexpr Reals d;
  constexpr std::size_t lanes = hn::MaxLanes(d), width = vectors * lanes;
  // high: [r][width] members - centre; low: what that lost when it was rounded (Knuth's TwoSum)
  for (std::size_t r = 0; r < form.n_regressors; ++r) {
    for (std::size_t v = 0; v < vectors; ++v) {
      V const member = hn::GatherIndex(d, candidates + r, place[v]), centre = hn::Set(d, form.centre[r]);
      V const step = hn::Sub(member, centre), back = hn::Sub(step, member);
      hn::StoreU(step, d, high + r * width + v * lanes);
      hn::StoreU(hn::Sub(hn::Sub(member, hn::Sub(step, back)), hn::Add(centre, back)), d, low + r * width + v * lanes);
    }
  }
  V squares[vectors] = {hn::Zero(d), hn::Zero(d)}, slope[vectors] = {hn::Zero(d), hn::Zero(d)};
  for (std::size_t i = 0; i < form.n_regressors; ++i) {
    DoubledSum<V> row[vectors] = {{hn::Zero(d), hn::Zero(d)}, {hn::Zero(d), hn::Zero(d)}};
    for (std::size_t j = i; j < form.n_regressors; ++j) {
      V const root = hn::Set(d, form.root[i * form.n_regressors + j]);
      V const root_low = hn::Set(d, form.root_low[i * form.n_regressors + j]);
      for (std::size_t v = 0; v < vectors; ++v) {
        V const step = hn::LoadU(d, high + j * width + v * lanes);
        row[v].add_product(root, step);
        row[v].add_correction(root, hn::LoadU(d, low + j * width + v * lanes));
        row[v].add_correction(root_low, step);
      }
    }
    for (std::size_t v = 0; v < vectors; ++v) {
      V const sum = hn::Add(row[v].sum, row[v].error);
      squares[v] = fused_mul_add(sum, sum, squares[v]);
    }
  }
  for (std::size_t v = 0; v < vectors; ++v) {
    for (std::size_t j = 0; j < form.n_regressors; ++j)
      slope[v] = fused_mul_add(hn::Set(d, form.slope[j]), hn::LoadU(d, high + j * width + v * lanes), slope[v]);
    V const above = fused_neg_mul_add(hn::Set(d, 2.0), slope[v], squares[v]);
    hn::StoreU(hn::Add(hn::Set(d, form.constant), above), d, energy + v * lanes);
  }
}

void all_energies(QuadraticForm const& form, Candidates const& candidates, double* HWY_RESTRICT energy,
                  double* HWY_RESTRICT workspace) {
  using Reals = hn::CappedTag<double, n_lanes>;
  using Indices = hn::RebindToSigned<Reals>;
  constexpr Indices indices;
  constexpr std::size_t lanes = hn::MaxLanes(indices), width = vectors * lanes;
  double* const high = workspace;
  double* const low = high + form.n_regressors * width;
  // made once: Highway 1.0.3 builds it through memory
  auto const lane = hn::Iota(indices, 0);
  auto const last = hn::Set(indices, static_cast<std::int64_t>(candidates.n_members) - 1);
  auto const stride = hn::Set(indices, static_cast<std::int64_t>(candidates.leading_dimension));
  double energies[width];
  for (std::size_t first = 0; first < candidates.n_members; first += width) {
    hn::Vec<Indices> place[vectors];
    for (std::size_t v = 0; v < vectors; ++v) {
      auto const begin = hn::Set(indices, static_cast<std::int64_t>(first + v * lanes));
      // lanes without a member repeat the last one
      place[v] = hn::Mul(hn::Min(hn::Add(begin, lane), last), stride);
    }
    lanes_energy<Reals>(form, candidates.data, place, high, low, energies);
    std::copy_n(energies, std::min(width, candidates.n_members - first), energy + first);
  }
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {

TORQUESCOPE_EXPORT(all_energies);

// of the widest vectors
constexpr std::size_t most_side_by_side = 2 * n_lanes;

}  // namespace

std::size_t quadratic_workspace_size(std::size_t n_regressors) { return 2 * n_regressors * most_side_by_side; }

void quadratic_energy(QuadraticForm const& form, Candidates const& candidates, double* energy, double* workspace) {
  assert(candidates.n_members == 0 || candidates.leading_dimension >= form.n_regressors);
  TORQUESCOPE_DISPATCH(all_energies)(form, candidates, energy, workspace);
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
