#include "engine/infer/validation/level_change.hpp"

#include <cmath>
#include <vector>

#include "engine/fit/statistics/blocked_cv.hpp"
#include "engine/fit/statistics/held_out_gain.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"
#include "engine/infer/pipeline/motion_limits.hpp"

namespace torquescope {

std::optional<LevelChange> level_change(TorqueTrace const& trace, Eigen::VectorXd const& residual, Eigen::Index memory,
                                        double least_fall) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < residual.size(); ++i)
    if (std::isfinite(residual[i])) rows.push_back(i);
  auto const n = static_cast<Eigen::Index>(rows.size());
  if (n < fewest_rows) return std::nullopt;
  Eigen::VectorXd const left = residual(rows), velocity = trace.velocity(rows), sign = velocity.array().sign();

  LevelChange change;
  change.recording = trace.recording;
  change.goes_both_ways = moves_both_ways(velocity);
  Eigen::MatrixXd const offset = Eigen::VectorXd::Ones(n);
  Eigen::MatrixXd columns = offset;
  if (change.goes_both_ways) {
    columns.resize(n, 2);
    columns << sign, offset;
  }
  Eigen::VectorXd const before = change.goes_both_ways ? blocked_residuals(left, offset, memory) : left;
  Eigen::VectorXd const with = blocked_residuals(left, columns, memory);
  if (held_out_gain(held_out_blocks(before, with, memory)).change != HeldOutChange::lower) return std::nullopt;
  double const torque = Eigen::VectorXd(trace.torque(rows)).norm();
  change.level = solve_scaled(columns, left)(0, 0);
  change.relerr_before = left.norm() / torque;
  change.relerr_with = with.norm() / torque;
  if (change.relerr_with > (1.0 - least_fall) * change.relerr_before) return std::nullopt;
  return change;
}

}  // namespace torquescope
