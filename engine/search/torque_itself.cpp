#include "engine/search/torque_itself.hpp"

#include "engine/statistics/scaled_solution.hpp"

namespace torquescope {
namespace {

Eigen::VectorXd torque_beside(ModelStage const& stage, CandidateColumns const& columns, SizedEffect const& effect) {
  return beside_columns(stage.comparison.common.columns_themselves(),
                        columns.plain_columns(effect.effect, effect.shape) * effect.parameters);
}

}  // namespace

double excess_in_torque_itself(ModelStage const& stage) {
  return mismatch_energy(in_torque_itself(stage.comparison.rows)).excess;
}

double energy_beside(ModelStage const& stage, CandidateColumns const& columns, SizedEffect const& effect) {
  return torque_beside(stage, columns, effect).squaredNorm();
}

double gain_in_torque_itself(ModelStage const& stage, CandidateColumns const& columns, SizedEffect const& effect) {
  MismatchRows const rows = in_torque_itself(stage.comparison.rows);
  Eigen::VectorXd const mismatch = rows.residual - rows.twin_mean;
  return mismatch.squaredNorm() - (mismatch - torque_beside(stage, columns, effect)).squaredNorm();
}

}  // namespace torquescope
