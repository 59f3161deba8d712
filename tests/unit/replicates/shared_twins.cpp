// What a diagnosis takes from its twins is the same to the bit whether it computed them or was given their numbers.

#include <gtest/gtest.h>

#include <deque>

#include "engine/infer/replicates/mismatch_rows.hpp"
#include "engine/infer/replicates/twin_whitening.hpp"
#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace shared_twins_test {

struct Batch {
  std::string identity;
  std::vector<std::vector<double>> twins;
};

// computes all, in two halves, the second one first; remembers every number
class Giver final : public TwinExchange {
 public:
  void fill(TwinBatch const& batch) override {
    std::size_t const middle = std::min(batch.range.to, batch.range.from + twin_lanes);
    if (middle < batch.range.to) batch.compute({middle, batch.range.to});
    batch.compute({batch.range.from, middle});
    Batch given{batch.identity, {}};
    for (std::size_t twin = batch.range.from; twin < batch.range.to; ++twin)
      batch.get(twin, given.twins.emplace_back(batch.numbers));
    batches.push_back(std::move(given));
  }
  std::deque<Batch> batches;
};

// computes nothing
class Taker final : public TwinExchange {
 public:
  explicit Taker(std::deque<Batch> given) : batches(std::move(given)) {}
  void fill(TwinBatch const& batch) override {
    ASSERT_FALSE(batches.empty());
    Batch const given = std::move(batches.front());
    batches.pop_front();
    EXPECT_EQ(given.identity, batch.identity);
    ASSERT_EQ(given.twins.size(), batch.range.size());
    for (std::size_t i = 0; i < given.twins.size(); ++i) batch.put(batch.range.from + i, given.twins[i]);
  }
  std::deque<Batch> batches;
};

struct Found {
  BaselineTwin baseline;
  RowWhitening whitening;
  TwinComparison comparison;
};

// with others: also of motions that somebody made before, as the stages of a search have them
Found found_by(TwinWorkers const& workers) {
  auto const recording = recorded(simulate_joint(clean_joint().plan, 12));
  auto pipeline = clean_pipeline(recording);
  constexpr std::size_t twins = 2 * twin_lanes;
  TwinOptions options{1e-4, twins, 1, 0};
  if (workers.exchange != nullptr) options.motions = pipeline.motions_of(recording);
  auto made = make_baseline_twin(recording, pipeline, clean_filter(), options, workers);
  auto whitening = twin_whitening(made.twin, pipeline, {1, 0, 5}, twins, workers);
  pipeline.weigh_with(std::make_shared<NoiseWeights const>(whitening));
  TwinAddress const address{1, 0, 6};
  auto comparison =
      workers.exchange == nullptr
          ? compare_with_twins(recording, made.twin, pipeline, address, twins + 3, workers)
          : compare_with_twins(made.record.motions(), recording.name, made.twin, pipeline, address, twins + 3, workers);
  if (options.motions) {
    EXPECT_EQ(&comparison.recording.motion->q, &options.motions->joint->q);
  }
  return {std::move(made), std::move(whitening), std::move(comparison)};
}

void expect_same(Found const& one, Found const& other) {
  EXPECT_EQ(one.baseline.baseline.parameters, other.baseline.baseline.parameters);
  EXPECT_EQ(one.baseline.baseline.std, other.baseline.baseline.std);
  EXPECT_EQ(one.baseline.disturbance.z, other.baseline.disturbance.z);
  EXPECT_EQ(one.baseline.friction_wander.std, other.baseline.friction_wander.std);
  EXPECT_EQ(one.comparison.rows.residual, other.comparison.rows.residual);
  EXPECT_EQ(one.comparison.rows.twins, other.comparison.rows.twins);
  EXPECT_EQ(one.comparison.rows.plain_twins, other.comparison.rows.plain_twins);
  EXPECT_EQ(one.comparison.rows.kept_rows, other.comparison.rows.kept_rows);
  EXPECT_EQ(one.comparison.twin_fits, other.comparison.twin_fits);
  EXPECT_EQ(one.comparison.ran_away, other.comparison.ran_away);
}

TEST(SharedTwins, SayTheSameWhoeverComputedThem) {
  Found const alone = found_by(2);
  Giver giver;
  expect_same(alone, found_by({1, &giver}));
  EXPECT_GE(giver.batches.size(), 4u);
  Taker taker(giver.batches);
  expect_same(alone, found_by({1, &taker}));
  EXPECT_TRUE(taker.batches.empty());
  for (std::size_t i = 1; i < giver.batches.size(); ++i)
    EXPECT_NE(giver.batches[i].identity, giver.batches[i - 1].identity);
}

TEST(SharedTwins, ThatRanAwayHaveRunAwayForEverybody) {
  auto const recording = recorded(simulate_joint(clean_joint().plan, 12));
  auto const pipeline = clean_pipeline(recording);
  auto const made = make_baseline_twin(recording, pipeline, clean_filter(), {1e-4, twin_lanes, 1, 0}, 2);
  TwinTrack track = made.twin.track();
  track.largest_torque = 1e-6;
  CleanTwin const weak(made.twin.joint(), made.twin.loop(), track, made.twin.step_s());
  auto const ran_away = [&](TwinExchange* exchange) {
    Eigen::VectorXd energy = Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(twin_lanes));
    return gather_twins(weak, pipeline, {1, 0, 5}, {0, 2 * twin_lanes}, {1, exchange}, {entry_each(energy)},
                        [](VisitedTwin const&) { FAIL() << "visited"; });
  };
  Giver giver;
  EXPECT_TRUE(ran_away(nullptr));
  EXPECT_TRUE(ran_away(&giver));
  Taker taker(giver.batches);
  EXPECT_TRUE(ran_away(&taker));
}

}  // namespace shared_twins_test
