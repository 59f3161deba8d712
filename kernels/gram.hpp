#pragma once
// Cross products of every column and the torque of a recording: all that a squared error depends on, in one sweep.
//
// Equation   gram          sums_ij = sum_t y_ti y_tj,  y_t = (phi_t1 .. phi_tR, tau_t)
//            whitened_gram the same with y_t = (q_t1 .. q_tR, e_t),  q = phi root^-1,  e = tau - phi centre: the second
//            pass, in which nothing cancels: the columns are nearly orthonormal, e is what a fit leaves over
// Shapes     phi: n_samples x n_regressors, column-major, columns leading_dimension apart; tau: n_samples;
//            root: R x R row-major, upper triangular (the rest is not read), no zero on the diagonal; centre: R;
//            sums: (R+1) x (R+1), symmetric, both triangles written
// Bits       the same on every instruction set with one rounding per operation: lane l sums samples l, l+8, ... of a
//            block of 2048 with fused multiply-add, lanes ((0+4)+(2+6)) + ((1+5)+(3+7)), blocks by PairwiseTree
// Error      gram: |error| <= g(D) sum_t |y_ti y_tj|, g and D as in residual_energy.hpp
// Memory     reads the columns where they are: no packed copy of the recording
// Threads    any number, each with its own workspace; does not allocate
// Source     two passes: CholeskyQR2, Yamamoto, Nakatsukasa, Yanagisawa, Fukaya, ETNA 44 (2015) 306-326

#include <cstddef>

namespace torquescope::kernels {

struct SampleColumns {
  double const* phi = nullptr;
  std::size_t leading_dimension = 0;  // >= n_samples
  double const* tau = nullptr;
  std::size_t n_samples = 0;
  std::size_t n_regressors = 0;
};

// doubles of workspace for either
std::size_t gram_workspace_size(std::size_t n_samples, std::size_t n_regressors);

void gram(SampleColumns const& samples, double* sums, double* workspace);

void whitened_gram(SampleColumns const& samples, double const* root, double const* centre, double* sums,
                   double* workspace);

}  // namespace torquescope::kernels
