#include "engine/infer/replicates/reversal_weights.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "engine/base/median.hpp"
#include "engine/infer/replicates/twin_batch.hpp"

namespace torquescope {
namespace {

struct RowSpread {
  double squares = 0.0;  // about the mean of those that keep the row
  int count = 0;
};

RowSpread spread_of(Eigen::Ref<Eigen::RowVectorXd const, 0, Eigen::InnerStride<>> const& row) {
  double sum = 0.0;
  RowSpread result;
  for (double const value : row)
    if (value != not_kept) {
      sum += value;
      ++result.count;
    }
  for (double const value : row)
    if (value != not_kept) result.squares += std::pow(value - sum / result.count, 2);
  return result;
}

// a quarter period of the cut-off either side: within it filtered rows are one and the same
Eigen::Index pooled_reach(RecordPipeline const& pipeline) {
  constexpr double periods = 0.25;
  if (!(pipeline.cutoff_hz() > 0.0)) return 0;
  return static_cast<Eigen::Index>(std::lround(periods * pipeline.kept_rate_hz() / pipeline.cutoff_hz()));
}

// infinite where too few replicates keep any row about it
Eigen::VectorXd pooled_variance(Eigen::MatrixXd const& residuals, Eigen::Index reach) {
  Eigen::Index const n = residuals.rows();
  std::vector<RowSpread> spread;
  for (Eigen::Index k = 0; k < n; ++k) {
    RowSpread const own = spread_of(residuals.row(k));
    spread.push_back(2 * own.count >= residuals.cols() ? own : RowSpread{});
  }
  Eigen::VectorXd variance(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    double squares = 0.0;
    int free = 0;
    bool const is_kept = spread[static_cast<std::size_t>(k)].count > 0;
    for (Eigen::Index i = std::max<Eigen::Index>(0, k - reach); is_kept && i < std::min(n, k + reach + 1); ++i) {
      RowSpread const& near = spread[static_cast<std::size_t>(i)];
      squares += near.squares;
      free += std::max(0, near.count - 1);
    }
    variance[k] = free > 0 ? squares / free : not_kept;
  }
  return variance;
}

NoiseWeights weights_of(NoiseWeights const& plain, Eigen::VectorXd const& variance,
                        std::vector<Eigen::Index> const& moving) {
  std::vector<double> ordinary;
  for (Eigen::Index const k : moving)
    if (variance[k] != not_kept) ordinary.push_back(variance[k]);
  if (ordinary.empty()) return plain;
  double const noise = upper_median(std::move(ordinary));
  return plain.with_shares(variance.unaryExpr([&](double one) { return one > noise ? std::sqrt(noise / one) : 1.0; }));
}

}  // namespace

NoiseWeights reversal_weights(BaselineTwin const& made, RecordPipeline& pipeline, RowWhitening const& rows,
                              TwinAddress const& address, std::size_t twins, TwinWorkers const& workers) {
  NoiseWeights plain(rows);
  std::vector<Eigen::Index> const moving = pipeline.own_rows(made.record.motion);
  pipeline.keep_reversals();
  pipeline.weigh_with(std::make_shared<NoiseWeights const>(plain));
  Eigen::MatrixXd residuals =
      Eigen::MatrixXd::Constant(pipeline.kept_samples(), static_cast<Eigen::Index>(twins), not_kept);
  TwinLoop steady = made.loop.loop;
  steady.friction_wander = steady.friction_wander_variance_error = 0.0;
  CleanTwin const twin(made.twin.joint(), steady, made.twin.track(), made.twin.step_s());
  bool const ran_away = gather_twins(twin, pipeline, address, {0, twins}, workers, {column_each(residuals)},
                                     [&](VisitedTwin const& visited) {
                                       auto const& record = visited.record;
                                       residuals(record.kept_rows, static_cast<Eigen::Index>(visited.index)) =
                                           record.torque - record.columns * made.baseline.parameters;
                                     });
  pipeline.keep_reversals(false);
  if (ran_away) return plain;
  NoiseWeights result = weights_of(plain, pooled_variance(residuals, pooled_reach(pipeline)), moving);
  pipeline.weigh_with(std::make_shared<NoiseWeights const>(result));
  return result;
}

}  // namespace torquescope
