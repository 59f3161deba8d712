#include "engine/workflows/drafts/gravity_evidence.hpp"

#include "engine/base/dense_solvers.hpp"
#include "engine/effects/regressor.hpp"
#include "engine/fit/problem/regression_data.hpp"

namespace torquescope {

GravityEvidence measure_gravity(Recording const& recording, FilterOptions const& filter,
                                std::vector<std::string> const& terms) {
  auto const data_of = [&](std::vector<std::string> const& model_terms) {
    Regressor const regressor(model_terms, JointKind::revolute, 0.0, Section{"model", {}, {}});
    return make_regression_data({recording}, filter, regressor, Section{"filter", {}, {}});
  };
  auto const residual_energy = [](Eigen::MatrixXd const& columns, Eigen::VectorXd const& torque) {
    Eigen::VectorXd const parameters = solve_pivoted(columns, torque);
    return (torque - columns * parameters).squaredNorm();
  };
  GravityEvidence evidence;
  evidence.range_rad = recording.position.maxCoeff() - recording.position.minCoeff();
  auto const model = data_of(terms);
  double const without = residual_energy(model.phi, model.tau);
  if (!(without > 0)) return evidence;
  auto with_weight = terms;
  with_weight.emplace_back("gravity");
  auto const weighted = data_of(with_weight);
  evidence.share = 1 - residual_energy(weighted.phi, weighted.tau) / without;
  Eigen::MatrixXd spring(model.phi.rows(), model.phi.cols() + 2);
  spring << model.phi, model.q, model.q.cwiseAbs2();
  evidence.share_spring = 1 - residual_energy(spring, model.tau) / without;
  return evidence;
}

}  // namespace torquescope
