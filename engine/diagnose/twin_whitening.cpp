#include "engine/diagnose/twin_whitening.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "engine/diagnose/blocked_cv.hpp"
#include "engine/diagnose/twin_batch.hpp"

namespace torquescope {
namespace {

// of rows that may be others than the common ones
struct TwinResidual {
  std::vector<Eigen::Index> rows;
  Eigen::VectorXd residual;
};

std::vector<Eigen::Index> common_rows(std::vector<TwinResidual> const& twins) {
  std::vector<Eigen::Index> all = twins.front().rows;
  for (auto const& twin : twins) {
    std::vector<Eigen::Index> both;
    std::set_intersection(all.begin(), all.end(), twin.rows.begin(), twin.rows.end(), std::back_inserter(both));
    all = std::move(both);
  }
  return all;
}

Eigen::MatrixXd residuals_on(std::vector<Eigen::Index> const& rows, std::vector<TwinResidual> const& twins) {
  Eigen::MatrixXd residuals(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(twins.size()));
  for (std::size_t t = 0; t < twins.size(); ++t) {
    std::size_t at = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      while (twins[t].rows[at] != rows[k]) ++at;
      residuals(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(t)) =
          twins[t].residual[static_cast<Eigen::Index>(at)];
    }
  }
  return residuals;
}

}  // namespace

RowWhitening twin_whitening(CleanTwin const& twin, RecordPipeline const& pipeline, TwinAddress const& address,
                            std::size_t twins, int threads) {
  std::vector<TwinResidual> found(twins);
  std::vector<char> ran_away(twins, 0);
  TwinLoop steady = twin.loop();
  steady.friction_wander = steady.friction_wander_variance_error = 0.0;
  for_each_twin(CleanTwin(twin.joint(), steady, twin.track(), twin.step_s()), pipeline, address, twins, threads,
                [&](VisitedTwin const& visited) {
                  ran_away[visited.index] = visited.ran_away;
                  found[visited.index] = {visited.record.kept_rows, visited.record.residual};
                });
  if (std::any_of(ran_away.begin(), ran_away.end(), [](char one) { return one != 0; })) return {};
  std::vector<Eigen::Index> const rows = common_rows(found);
  if (rows.size() < static_cast<std::size_t>(fewest_rows)) return {};
  Eigen::MatrixXd noise = residuals_on(rows, found);
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
