#pragma once
// How many independent squares a residual is worth, and the statistic that compares two nested models with them.
//
// Equation   n_eff = n / (1 + 2 sum_k w_k rho_k^2), w: Bartlett's taper; the variance of a mean of squares of a
//            Gaussian series is 2 sigma^4 / n_eff
//            D = sum over channels of n_eff ln(S_0 / S_1), S: sums of squares, n_eff: of the larger model's residual
// Threads    free functions
// Source     Bartlett 1946, doi:10.2307/2983611; Priestley 1981, Spectral Analysis and Time Series, section 5.3,
//            ISBN 978-0-12-564922-3

#include <Eigen/Core>

namespace torquescope {

// of one stretch without gaps; residual about zero. A residual of zeros is worth its samples
double effective_samples(Eigen::Ref<Eigen::VectorXd const> const& residual);

}  // namespace torquescope
