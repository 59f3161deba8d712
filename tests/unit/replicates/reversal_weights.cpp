// Rows near reversals, weighed by replicates of unknown sticking laws: all rows of others are then as loud as one
// another.

#include "engine/infer/replicates/reversal_weights.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "engine/infer/replicates/twin_batch.hpp"
#include "engine/infer/replicates/twin_whitening.hpp"
#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace reversal_weights_test {

constexpr std::size_t twins = 2 * twin_lanes;

struct Made {
  Recording recording;
  BaselineTwin twin;
  RowWhitening rows;
};

// a loop that is stiff beside its friction: it rests at no reversal
Made made(int threads) {
  SimulationPlan plan = clean_joint(0.036, 0.164, 0.3, -0.03).plan;
  plan.controller.bandwidth_hz = 20.0;
  Recording recording = recorded(simulate_joint(plan, 12));
  RecordPipeline const masked = clean_pipeline(recording);
  TwinOptions options{1e-4, twins, 1, 0};
  options.draws_sticking = true;
  BaselineTwin twin = make_baseline_twin(recording, masked, clean_filter(), options, threads);
  RowWhitening rows = twin_whitening(twin.twin, masked, {1, 0, 5}, twins, threads);
  return {std::move(recording), std::move(twin), std::move(rows)};
}

NoiseWeights weights_of(Made const& one, int threads) {
  RecordPipeline pipeline = clean_pipeline(one.recording);
  return reversal_weights(one.twin, pipeline, one.rows, {1, 0, 6}, twins, threads);
}

// mean variance over replicates of rows that the mask leaves out, over that of the others
double loudness_of_reversals(Made const& one, NoiseWeights const& weights) {
  RecordPipeline pipeline = clean_pipeline(one.recording);
  pipeline.keep_reversals();
  pipeline.weigh_with(std::make_shared<NoiseWeights const>(weights));
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(pipeline.kept_samples()), squares = sum, kept = sum;
  for_each_twin(one.twin.twin, pipeline, {1, 0, 9}, twins, 1, [&](VisitedTwin const& visited) {
    auto const& record = visited.record;
    Eigen::ArrayXd const noise = record.torque - record.columns * one.twin.baseline.parameters;
    sum(record.kept_rows) += noise;
    squares(record.kept_rows) += noise.square();
    kept(record.kept_rows) += 1.0;
  });
  std::vector<bool> is_moving(static_cast<std::size_t>(pipeline.kept_samples()), false);
  for (Eigen::Index const k : one.twin.record.kept_rows) is_moving[static_cast<std::size_t>(k)] = true;
  double variance[2] = {}, rows[2] = {};
  for (Eigen::Index k = 0; k < sum.size(); ++k) {
    if (kept[k] < static_cast<double>(twins)) continue;
    int const at = is_moving[static_cast<std::size_t>(k)] ? 1 : 0;
    variance[at] += (squares[k] - sum[k] * sum[k] / kept[k]) / (kept[k] - 1.0);
    ++rows[at];
  }
  EXPECT_GT(rows[0], 0.05 * rows[1]);
  return variance[0] / rows[0] / (variance[1] / rows[1]);
}

TEST(ReversalWeights, MakeRowsNearReversalsAsLoudAsTheOthers) {
  Made const one = made(1);
  EXPECT_TRUE(one.twin.loop.loop.sticking.is_any());
  NoiseWeights const weights = weights_of(one, 1);
  ASSERT_TRUE(weights.weigh_reversals());
  double const before = loudness_of_reversals(one, NoiseWeights(one.rows)), after = loudness_of_reversals(one, weights);
  std::printf("rows near reversals are %.2f times as loud, weighed %.2f\n", before, after);
  EXPECT_GT(before, 2.0);
  EXPECT_GT(after, 0.5);
  EXPECT_LT(after, 2.0);
}

TEST(ReversalWeights, KeepTheRowsThatTheMaskLeavesOutAndHaveTheSameBitsOnAnyThreads) {
  Made const one = made(1);
  NoiseWeights const alone = weights_of(one, 1);
  NoiseWeights const shared = weights_of(one, 3);
  RecordPipeline weighed = clean_pipeline(one.recording);
  weighed.weigh_with(std::make_shared<NoiseWeights const>(alone));
  ProcessedRecord const record = weighed.process(one.recording);
  EXPECT_GT(record.kept_rows.size(), one.twin.record.kept_rows.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(record.kept_rows.size()), 1), b = a;
  alone.take_shares(a, record.kept_rows);
  shared.take_shares(b, record.kept_rows);
  EXPECT_EQ(a, b);
  EXPECT_EQ(a.maxCoeff(), 1.0);
  EXPECT_LT(a.minCoeff(), 0.7);
}

}  // namespace reversal_weights_test
