#pragma once
// The sum of squared residuals of a block of candidates from sufficient statistics: R^2 / 2 operations, whatever n.
//
// Equation   energy_m = constant - 2 slope . d_m + |(root + root_low) d_m|^2,  d_m = v_m - centre
// Shapes     candidates: n_members rows of n_regressors numbers, leading_dimension apart; root, root_low: R x R
//            row-major, upper triangular (the rest is not read); slope, centre: R
// Precision  d and root d in doubled precision (Dot2): along a direction the recording hardly sees, large terms cancel.
//            root_low holds what root lost when it was rounded
// Bits       the same on every instruction set, in any grouping of members: d by TwoSum; row i of root d by j = i, i+1,
//            ... as Dot2, low parts root d_low, then root_low d, joining the errors; squares by i, then slope . d by j
//            with fused multiply-add, then constant + (squares - 2 slope . d)
// Not finite a NaN or infinite parameter makes its own member NaN or infinite; the others are untouched
// Threads    any number on the same form, each with its own workspace; does not allocate
// Source     Ogita, Rump, Oishi: Accurate sum and dot product, SIAM J. Sci. Comput. 26 (2005) 1955-1988

#include <cstddef>

#include "kernels/residual_energy.hpp"

namespace torquescope::kernels {

struct QuadraticForm {
  std::size_t n_regressors = 0;
  double const* centre = nullptr;
  double const* root = nullptr;
  double const* root_low = nullptr;
  double const* slope = nullptr;
  double constant = 0.0;
};

// doubles of workspace, whatever the number of members
std::size_t quadratic_workspace_size(std::size_t n_regressors);

void quadratic_energy(QuadraticForm const& form, Candidates const& candidates, double* energy, double* workspace);

}  // namespace torquescope::kernels
