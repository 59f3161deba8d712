#include "engine/robot/forward_dynamics.hpp"

#include <Eigen/Cholesky>

namespace torquescope {

Eigen::MatrixXd mass_matrix(SerialChain const& chain, JointVector const& parameters, JointVector const& q) {
  SerialChain weightless = chain;
  weightless.gravity.setZero();
  Eigen::Index const n = chain.size();
  Eigen::VectorXd const still = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd mass(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    mass.col(j) = inverse_dynamics(weightless, parameters, q, still, Eigen::VectorXd::Unit(n, j));
  return 0.5 * (mass + mass.transpose());  // equal up to rounding
}

bool is_positive_definite(Eigen::MatrixXd const& mass_matrix) { return mass_matrix.llt().info() == Eigen::Success; }

Eigen::VectorXd forward_dynamics(SerialChain const& chain, JointVector const& parameters, JointVector const& q,
                                 JointVector const& dq, JointVector const& tau) {
  Eigen::VectorXd const bias = inverse_dynamics(chain, parameters, q, dq, Eigen::VectorXd::Zero(chain.size()));
  return mass_matrix(chain, parameters, q).llt().solve(tau - bias);
}

}  // namespace torquescope
