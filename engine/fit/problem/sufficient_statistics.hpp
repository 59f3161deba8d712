#pragma once
// The squared error of a linear problem as a quadratic form around its minimum: R^2 / 2 operations per evaluation.
//
// Equation   sum_t (tau_t - phi_t v)^2 = constant - 2 slope . (v - centre) + |root (v - centre)|^2; first sweep:
//            phi'phi (scaled), root and centre by Cholesky; second: the same of phi root^-1 and of the residual at the
//            centre
// Shapes     phi: n x R, tau: n
// Error      of the MSE, relative: about 4 R 2^-53 rms(|tau| + sum_r |phi_r centre_r| + sum_r |phi_r (v - centre)_r|) /
//            sqrt(least MSE); below 1e-12 in the tests where usable(). One sweep alone loses 1e-16 tau'tau / MSE
// Usable     least MSE at least 1e-8 of the torque's mean square, condition (unit columns) at most 1e8, n > R
// Bits       the same on every instruction set (kernels/gram.hpp; R x R algebra without vector target)
// Threads    immutable once made
// Source     CholeskyQR2: Yamamoto, Nakatsukasa, Yanagisawa, Fukaya, ETNA 44 (2015) 306-326

#include <Eigen/Core>
#include <string>

#include "kernels/quadratic_energy.hpp"

namespace torquescope {

class SufficientStatistics {
 public:
  static constexpr double least_noise_share = 1e-8;
  static constexpr double largest_condition = 1e8;

  SufficientStatistics(Eigen::MatrixXd const& phi, Eigen::VectorXd const& tau);

  bool usable() const { return refusal_.empty(); }
  // why not, for a person; "" when usable
  std::string const& refusal() const { return refusal_; }

  // least MSE over the mean square of the torque; NaN where the columns are dependent
  double noise_share() const { return noise_share_; }
  double condition() const { return condition_; }
  Eigen::VectorXd const& centre() const { return centre_; }

  // Requires   usable(); points into this object
  kernels::QuadraticForm form() const;

 private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  bool solve(Eigen::MatrixXd const& phi, Eigen::VectorXd const& tau);

  RowMajor root_, root_low_;  // their sum is the root
  Eigen::VectorXd centre_, slope_;
  double constant_ = 0.0;
  double noise_share_, condition_;
  std::string refusal_;
};

}  // namespace torquescope
