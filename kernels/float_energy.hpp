#pragma once
// Sum of squared residuals of a block of candidates in float32: half the memory and twice the lanes of residual_energy.
//
// Equation   e_i = tau_i - sum_r phi_ir v_mr in float32; energy_m = sum_i e_i^2, float32 within a block, double beyond
// Shapes     tiles of 64 samples (sample_tiles.hpp); candidates: n_members rows of n_regressors numbers; energy:
//            n_members
// Bits       the same on every instruction set, for any grouping of members, on any number of threads: inputs rounded
//            to nearest; e by r = 0, 1, ... with one rounding each; lane l sums samples l, l+16, ... of a block of 2048
//            with fused multiply-add; lanes l and l+8 added in double, then as residual_energy; blocks by PairwiseTree
// Error      relative to the energy about 2^-24 rms(|tau| + sum_r |phi_r v_r|) / rms(e) per residual, independent
//            of each other: 1e-8 to 1e-6 of the sum where the residual is 0.1 to 0.001 of the torque
//            (tests/unit/kernels/float_energy.cpp); worthless where e is rounding itself
// Range      numbers and energy of a block below 3e38, squares of interest above 1e-38; beyond: infinite or zero
// Threads    any number on the same tiles, each with its own workspace; does not allocate

#include <cstddef>

#include "kernels/residual_energy.hpp"

namespace torquescope::kernels {

// floats and doubles of workspace
std::size_t float_workspace_size(std::size_t n_regressors, std::size_t n_members);
std::size_t float_sums_size(std::size_t n_samples, std::size_t n_members);

void float_residual_energy(FloatTiles const& tiles, Candidates const& candidates, double* energy, float* workspace,
                           double* sums);

}  // namespace torquescope::kernels
