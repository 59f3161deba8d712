#include "engine/infer/replicates/twin_whitening.hpp"

#include <cmath>
#include <vector>

#include "engine/fit/statistics/blocked_cv.hpp"
#include "engine/infer/replicates/twin_batch.hpp"

namespace torquescope {
namespace {

std::vector<Eigen::Index> common_rows(Eigen::MatrixXd const& residuals) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index k = 0; k < residuals.rows(); ++k)
    if ((residuals.row(k).array() != not_kept).all()) rows.push_back(k);
  return rows;
}

}  // namespace

RowWhitening twin_whitening(CleanTwin const& twin, RecordPipeline const& pipeline, TwinAddress const& address,
                            std::size_t twins, TwinWorkers const& workers) {
  Eigen::MatrixXd residuals =
      Eigen::MatrixXd::Constant(pipeline.kept_samples(), static_cast<Eigen::Index>(twins), not_kept);
  TwinLoop steady = twin.loop();
  steady.friction_wander = steady.friction_wander_variance_error = 0.0;
  CleanTwin const steady_twin(twin.joint(), steady, twin.track(), twin.step_s());
  bool const ran_away = gather_twins(
      steady_twin, pipeline, address, {0, twins}, workers, {column_each(residuals)}, [&](VisitedTwin const& visited) {
        residuals(visited.record.kept_rows, static_cast<Eigen::Index>(visited.index)) = visited.record.residual;
      });
  if (ran_away) return {};
  std::vector<Eigen::Index> const rows = common_rows(residuals);
  if (rows.size() < static_cast<std::size_t>(fewest_rows)) return {};
  Eigen::MatrixXd noise = residuals(rows, Eigen::all);
  auto const m = static_cast<double>(twins);
  noise = (std::sqrt(m / (m - 1.0)) * (noise.colwise() - noise.rowwise().mean().eval())).eval();
  return whitening_of(noise, rows, pipeline.cutoff_hz() > 0.0 ? pipeline.cutoff_hz() / pipeline.kept_rate_hz() : 0.5);
}

NoiseWeights with_wander_of(BaselineTwin const& made, NoiseWeights const& weights, RecordPipeline const& pipeline) {
  constexpr double mean_draw = 0.4;  // of a normal variable cut off at 0, for each standard deviation about 0
  FrictionWander const wander(made.record, pipeline, made.twin.joint(), WanderReading::by_itself);
  if (!wander.is_measurable()) return weights;
  NoiseLevel const& level = made.friction_wander;
  return weights.with_wander(wander.friction(), wander.duration_s(),
                             level.std * level.std + mean_draw * level.variance_error);
}

}  // namespace torquescope
