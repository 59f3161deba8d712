#pragma once
// The two one-sided Coulomb parameters of the seed paper (CITATION.cff) as friction and offset: the same model.
//
// Equation   Fc = (a3 - a4) / 2, b = (a3 + a4) / 2; everything else unchanged; values = map * parameters
// Shapes     map: K x R, K = R
// Why        a3 = 0.0089, a4 = -0.2582 reads as two odd frictions; it is Fc = 0.134 with an offset of -0.125
// Threads    const object

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "engine/effects/regressor.hpp"

namespace torquescope {

struct JointForm {
  std::vector<std::string> names;  // "inertia", "viscous", "coulomb", "offset"
  std::vector<std::string> units;
  Eigen::MatrixXd map;

  Eigen::VectorXd values(Eigen::VectorXd const& parameters) const { return map * parameters; }
  // of the values, from the covariance of the parameters (their correlation counts: a3 and a4 share the offset)
  Eigen::VectorXd standard_errors(Eigen::MatrixXd const& covariance) const {
    return (map * covariance * map.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
  }
};

// nothing when the model does not hold coulomb_positive with coulomb_negative
std::optional<JointForm> joint_form(Regressor const& regressor);

}  // namespace torquescope
