#include "engine/infer/search/late_torque.hpp"

#include <array>
#include <cmath>

namespace torquescope {

std::optional<LateTorque> late_torque(ModelStage const& stage, CandidateColumns const& columns, double rate_hz) {
  static Effect const* const delay = find_effect("delay");
  OrthonormalGroup const group = columns.group(*delay, std::array{longest_timing / rate_hz});
  if (group.rank() == 0) return std::nullopt;
  auto const& rows = stage.comparison.rows;
  Eigen::VectorXd const own = group.q.transpose() * stage.mismatch();
  Eigen::MatrixXd const twins = group.q.transpose() * (rows.twins.colwise() - rows.twin_mean);
  double const variance = twins.squaredNorm() / static_cast<double>(rows.n_twins() - 1);
  if (!(variance > 0.0)) return std::nullopt;
  return LateTorque{bounded_gain(group, own).parameters[0], own.norm() / std::sqrt(variance),
                    own.squaredNorm() - variance};
}

}  // namespace torquescope
