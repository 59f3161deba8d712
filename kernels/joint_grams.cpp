#include "kernels/joint_grams.hpp"

#include <algorithm>

#include "kernels/dispatch-inl.hpp"
#include "kernels/lane_sum.hpp"
#include "kernels/pairwise_tree.hpp"

// the part up to HWY_ONCE is compiled once per instruction set
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/joint_grams.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "kernels/double_lanes-inl.hpp"

#ifndef TORQUESCOPE_KERNELS_JOINT_GRAMS_PAIRS
#define TORQUESCOPE_KERNELS_JOINT_GRAMS_PAIRS
namespace torquescope::kernels {
constexpr std::size_t pairs_of(std::size_t width) { return width * (width + 1) / 2; }
// place of (i, i) in the upper triangle, row by row
constexpr std::size_t diagonal_place(std::size_t i, std::size_t width) { return i * width - i * (i + 1) / 2 + i; }
}  // namespace torquescope::kernels
#endif

HWY_BEFORE_NAMESPACE();
namespace torquescope::kernels::HWY_NAMESPACE {
namespace {

// side of a square of products held in registers: 16 of 32, or 9 of 16
inline constexpr std::size_t side = vector_lanes == n_lanes ? 4 : 3;

// pairs (i + a, j + b), a < I, b < J; on the diagonal, where i = j, those with a <= b
enum class Place { above, on_diagonal };

template <std::size_t I, std::size_t J, Place place>
HWY_INLINE void add_square(double const* HWY_RESTRICT rows, std::size_t width, std::size_t n_groups, std::size_t i,
                           std::size_t j, double* HWY_RESTRICT lanes) {
  double* at[I];
#pragma GCC unroll 4
  for (std::size_t a = 0; a < I; ++a) at[a] = lanes + (diagonal_place(i + a, width) + j - i - a) * n_lanes;
  auto const has = [](std::size_t a, std::size_t b) { return place == Place::above || a <= b; };

  for (std::size_t lane = 0; lane < n_lanes; lane += vector_lanes) {
    V sum[I][J];
#pragma GCC unroll 4
    for (std::size_t a = 0; a < I; ++a)
#pragma GCC unroll 4
      for (std::size_t b = 0; b < J; ++b)
        if (has(a, b)) sum[a][b] = hn::LoadU(d, at[a] + b * n_lanes + lane);

    double const *left = rows + i * n_lanes + lane, *right = rows + j * n_lanes + lane;
    for (std::size_t group = 0; group < n_groups; ++group, left += width * n_lanes, right += width * n_lanes) {
      V factor[J];
#pragma GCC unroll 4
      for (std::size_t b = 0; b < J; ++b) factor[b] = hn::LoadU(d, right + b * n_lanes);
#pragma GCC unroll 4
      for (std::size_t a = 0; a < I; ++a) {
        V const other = place == Place::on_diagonal ? factor[a] : hn::LoadU(d, left + a * n_lanes);
#pragma GCC unroll 4
        for (std::size_t b = 0; b < J; ++b)
          if (has(a, b)) sum[a][b] = fused_mul_add(other, factor[b], sum[a][b]);
      }
    }

#pragma GCC unroll 4
    for (std::size_t a = 0; a < I; ++a)
#pragma GCC unroll 4
      for (std::size_t b = 0; b < J; ++b)
        if (has(a, b)) hn::StoreU(sum[a][b], d, at[a] + b * n_lanes + lane);
  }
}

// I rows of the triangle from row i on
template <std::size_t I>
HWY_INLINE void add_rows(double const* rows, std::size_t width, std::size_t n_groups, std::size_t i, double* lanes) {
  add_square<I, I, Place::on_diagonal>(rows, width, n_groups, i, i, lanes);
  std::size_t j = i + I;
  for (; j + side <= width; j += side) add_square<I, side, Place::above>(rows, width, n_groups, i, j, lanes);
  if (width - j == 3) return add_square<I, 3, Place::above>(rows, width, n_groups, i, j, lanes);
  if (width - j == 2) return add_square<I, 2, Place::above>(rows, width, n_groups, i, j, lanes);
  if (width - j == 1) return add_square<I, 1, Place::above>(rows, width, n_groups, i, j, lanes);
}

}  // namespace

void add_products_of_rows(double const* rows, std::size_t width, std::size_t n_groups, double* lanes) {
  std::size_t i = 0;
  for (; i + side <= width; i += side) add_rows<side>(rows, width, n_groups, i, lanes);
  if (width - i == 3) return add_rows<3>(rows, width, n_groups, i, lanes);
  if (width - i == 2) return add_rows<2>(rows, width, n_groups, i, lanes);
  if (width - i == 1) return add_rows<1>(rows, width, n_groups, i, lanes);
}

}  // namespace torquescope::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace torquescope::kernels {
namespace {

TORQUESCOPE_EXPORT(add_products_of_rows);

static_assert(gram_block_samples % row_block_samples == 0);

// samples first .. first + count of one block, summed to pairs
void sum_block(ArmPlan const& plan, JointSignals const* signals, std::size_t first, std::size_t count, double* pairs,
               double* lanes, double* rows, double* workspace) {
  std::size_t const n_pairs = pairs_before(plan, plan.size());
  std::fill_n(lanes, n_pairs * n_lanes, 0.0);
  for (std::size_t begin = 0; begin < count; begin += row_block_samples) {
    std::size_t const samples = std::min(row_block_samples, count - begin), next = begin + samples;
    arm_rows(plan, signals, first + begin, samples, rows, workspace);
    double* of_joint = lanes;
    for (std::size_t j = 0; j < plan.size(); ++j) {
      std::size_t const width = plan.row_width(j);
      prefetch_samples(signals[j], first + next, std::min(row_block_samples, count - next));
      add_products(rows + plan.rows_before(j), width, group_count(samples), of_joint);
      of_joint += pairs_of(width) * n_lanes;
    }
  }
  for (std::size_t pair = 0; pair < n_pairs; ++pair) pairs[pair] = sum_lanes(lanes + pair * n_lanes);
}

}  // namespace

std::size_t pairs_before(ArmPlan const& plan, std::size_t joint) {
  std::size_t before = 0;
  for (std::size_t j = 0; j < joint; ++j) before += pairs_of(plan.row_width(j));
  return before;
}

std::size_t joint_grams_workspace_size(ArmPlan const& plan, std::size_t n_samples) {
  std::size_t const n_pairs = pairs_before(plan, plan.size());
  std::size_t const n_blocks = (n_samples + gram_block_samples - 1) / gram_block_samples;
  return plan.rows_before(plan.size()) + n_pairs * n_lanes + arm_rows_workspace_size(plan) +
         PairwiseTree::workspace_size(n_blocks, n_pairs);
}

void joint_grams(ArmPlan const& plan, JointSignals const* signals, std::size_t first, std::size_t count, double* pairs,
                 double* workspace) {
  std::size_t const n_pairs = pairs_before(plan, plan.size());
  // what is loaded as whole vectors first: a cache line each
  double* const lanes = workspace;
  double* const rows = lanes + n_pairs * n_lanes;
  double* const row_workspace = rows + plan.rows_before(plan.size());
  PairwiseTree tree(n_pairs, row_workspace + arm_rows_workspace_size(plan));
  for (std::size_t begin = 0; begin < count; begin += gram_block_samples) {
    sum_block(plan, signals, first + begin, std::min(gram_block_samples, count - begin), pairs, lanes, rows,
              row_workspace);
    tree.add(pairs);
  }
  tree.total(pairs);
}

void add_products(double const* rows, std::size_t width, std::size_t n_groups, double* lanes) {
  TORQUESCOPE_DISPATCH(add_products_of_rows)(rows, width, n_groups, lanes);
}

}  // namespace torquescope::kernels
#endif  // HWY_ONCE
