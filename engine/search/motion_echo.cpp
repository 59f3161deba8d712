#include "engine/search/motion_echo.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/statistics/twin_null.hpp"

namespace torquescope {
namespace {

constexpr Eigen::Index n_steps = 24;

// n samples x n_steps; before the recording the joint had its first acceleration
Eigen::MatrixXd past_accelerations(Motion const& motion, double cutoff_hz) {
  double const step_s = cutoff_hz > 0.0 ? 0.5 / cutoff_hz : 4.0 / motion.rate_hz;
  auto const step = std::max<Eigen::Index>(1, std::llround(step_s * motion.rate_hz));
  Eigen::Index const n = motion.ddq.size();
  Eigen::MatrixXd past(n, n_steps);
  for (Eigen::Index k = 0; k < n_steps; ++k) {
    Eigen::Index const ago = std::min(n - 1, (k + 1) * step);
    past.col(k).head(ago).setConstant(motion.ddq[0]);
    past.col(k).tail(n - ago) = motion.ddq.head(n - ago);
  }
  return past;
}

}  // namespace

double motion_echo_p(ModelStage const& stage) {
  RecordPipeline const& pipeline = *stage.pipeline;
  auto const& rows = stage.comparison.rows;
  ProcessedRecord const& common = stage.comparison.common;
  Eigen::MatrixXd columns = pipeline.filtered_columns(past_accelerations(common.motion, pipeline.cutoff_hz()), common);
  pipeline.whiten(columns, common.kept_rows);
  CandidateColumns const model(pipeline, stage.comparison, stage.reference(), stage.parameters());
  OrthonormalGroup const group =
      orthonormal_group(std::move(columns), model.nuisance(), std::vector<bool>(n_steps, false));
  if (group.rank() == 0) return 1.0;
  Eigen::MatrixXd const apart = rows.twins.colwise() - rows.twin_mean;
  Eigen::RowVectorXd const twins = inner_products(group.q, apart).colwise().norm();
  double const own = inner_products(group.q, stage.mismatch()).norm();
  return tail_p(own, {twins.data(), static_cast<std::size_t>(twins.size())});
}

}  // namespace torquescope
