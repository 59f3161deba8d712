#include "engine/robot/forward_dynamics.hpp"

#include "engine/base/dense_solvers.hpp"
#include "engine/robot/arm_equation.hpp"

namespace torquescope {

Eigen::MatrixXd mass_matrix(SerialChain const& chain, JointVector const& parameters, JointVector const& q) {
  ArmEquation equation(chain, parameters);
  equation.set(q, Eigen::VectorXd::Zero(chain.size()));
  return equation.mass();
}

bool is_positive_definite(Eigen::MatrixXd const& mass_matrix) { return cholesky_of(mass_matrix).has_value(); }

Eigen::VectorXd forward_dynamics(SerialChain const& chain, JointVector const& parameters, JointVector const& q,
                                 JointVector const& dq, JointVector const& tau) {
  ArmEquation equation(chain, parameters);
  equation.set(q, dq);
  return solve_positive(equation.mass(), Eigen::VectorXd(tau - equation.bias()));
}

}  // namespace torquescope
