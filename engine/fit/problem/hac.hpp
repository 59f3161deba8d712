#pragma once
// Standard errors for residuals that are not white: Newey-West, with the bandwidth chosen from the data.
//
// Equation   covariance = B S B n / (n - R), B = (mean psi' sum_t phi_t phi_t')^-1
//            S = sum of (1 - |j| / (L + 1)) s_t s_{t-j}' over recordings, rows t and lags |j| <= L
//            s_t = phi_t psi_t, the row's part of the normal equations
// Lags       Andrews: L = 1.1447 (a n)^(1/3) - 1 with a from a first-order autoregression of each column of s; never
//            across the border of two recordings; L = 0 is White's heteroscedasticity-consistent covariance
// Intervals  critical_value(L, n) replaces 1.96: the fixed-b distribution of a Bartlett t statistic, b = (L + 1) / n,
//            because a bandwidth that is not small against n makes the error itself uncertain
// Coverage   of 95 % intervals, 400 draws of 2000 samples, the worst of the seed's four parameters, for noise with
//            rho = 0, 0.5, 0.9, 0.98: 0.95, 0.94, 0.93, 0.89; naive intervals: 0.95, 0.77, 0.45, 0.27
// Arms       scores of an instant add up; 0 without rows (Datta, Du 2012, 10.17016/ifdp.2012.1060); hac_bias.hpp
// Requires   rows in time order within each recording
// Threads    free functions
// Source     Newey, West 1987; Andrews 1991 eq. 6.4; Kiefer, Vogelsang 2005 table 1 (checked by simulation)

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace torquescope {

// s_t = phi_t psi_t, made block by block where they are needed; points to its parts
struct RowScores {
  Eigen::MatrixXd const& phi;                  // [n][R]
  Eigen::VectorXd const& psi;                  // [n]
  std::vector<Eigen::Index> const& first_row;  // [recordings + 1]
};

std::int64_t andrews_lags(RowScores const& scores);

// bread: [R][R], B above; lags >= 0
Eigen::MatrixXd newey_west_covariance(RowScores const& scores, Eigen::MatrixXd const& bread, std::int64_t lags);

// half-width of a 95 % interval in standard errors; 1.96 for lags = 0
double critical_value(std::int64_t lags, Eigen::Index n_rows);

}  // namespace torquescope
