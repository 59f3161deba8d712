#pragma once
// Products of every joint's columns and torque over samples of a moving arm: all that least squares asks of them.
//
// Equation   of joint j: sum_t y_ta y_tb, y_t the joint's row of sample t (arm_rows.hpp: columns, then the torque)
// Shapes     pairs: joint after joint, upper triangle row by row, width (width + 1) / 2 numbers; pair_count() in all
// Bits       the same on every instruction set: lane l sums samples l, l + 8, ... of a block of 2048 with fused
//            multiply-add, lanes and blocks as in gram.hpp. Blocks first .. first + 2^k that begin at a multiple of 2^k
//            are a node of the tree, so any number of threads can share them
// Error      |error| <= g(D) sum_t |y_ta y_tb|, g and D as in residual_energy.hpp
// Memory     rows of 128 samples at a time, lanes of all pairs: some 400 KB for six joints
// Threads    any number, each with its own workspace; does not allocate

#include <cstddef>

#include "kernels/arm_rows.hpp"

namespace torquescope::kernels {

// samples of one block of summation
inline constexpr std::size_t gram_block_samples = 2048;

// pairs of the joints before `joint`, which may be size(): all pairs
std::size_t pairs_before(ArmPlan const& plan, std::size_t joint);

// n_samples: the most that one call sums
std::size_t joint_grams_workspace_size(ArmPlan const& plan, std::size_t n_samples);

// samples first .. first + count; first a multiple of gram_block_samples
void joint_grams(ArmPlan const& plan, JointSignals const* signals, std::size_t first, std::size_t count, double* pairs,
                 double* workspace);

// adds the products of n_groups groups of 8 rows to lanes[pair][8], pairs in the order above
void add_products(double const* rows, std::size_t width, std::size_t n_groups, double* lanes);

}  // namespace torquescope::kernels
