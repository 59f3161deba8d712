// Weights of another recording's rows: those of training where it is the same recording, its own where it is longer.

#include "engine/infer/search/weights_elsewhere.hpp"

#include <gtest/gtest.h>

#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace weights_elsewhere_test {

class WeightsElsewhere : public testing::Test {
 protected:
  static Recording recording_of(double duration_s, std::uint32_t index) {
    CleanJoint joint = clean_joint();
    joint.plan.simulation.duration_s = duration_s;
    joint.plan.noise.torque_std *= 0.3;
    return recorded(simulate_joint(joint.plan, index));
  }

  // ones on the rows of that recording, whitened
  Eigen::MatrixXd whitened(Recording const& other) const {
    RecordPipeline pipeline = pipeline_for(setting, other, stage);
    weigh_elsewhere(setting, stage, other, stage.parameters(), nullptr, 1, pipeline);
    std::vector<Eigen::Index> const rows = pipeline.own_rows(differentiate(other, filter, section));
    Eigen::MatrixXd signals = Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(rows.size()), 1);
    pipeline.whiten(signals, rows);
    return signals;
  }

  FilterOptions const filter = clean_filter();
  Section const section{};
  Recording const recording = recording_of(24.0, 3);
  StageSetting const setting{recording, clean_regressor(), filter, section, 32, 1, 2};
  ModelStage const stage = make_stage(setting, clean_regressor()).value();
};

TEST_F(WeightsElsewhere, AreTrainingsOnTrainingItself) {
  ASSERT_TRUE(stage.pipeline->whitens());
  auto const& trained = *stage.pipeline->weights();
  RecordPipeline const pipeline = pipeline_for(setting, recording, stage);
  std::vector<Eigen::Index> const rows = pipeline.own_rows(differentiate(recording, filter, section));
  Eigen::MatrixXd expected = Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(rows.size()), 1);
  trained.apply(expected, rows, trained.wander_on(rows));
  // the walk's level was read once more with the weights in place
  constexpr double level_read_again = 0.02;
  EXPECT_LT((whitened(recording) - expected).norm(), level_read_again * expected.norm());
}

// rows beyond the end of training: they have neighbours and a walk of their own
TEST_F(WeightsElsewhere, AreFiniteAndOfTheSameSizeOnALongerRecording) {
  Eigen::MatrixXd const here = whitened(recording), there = whitened(recording_of(48.0, 4));
  ASSERT_GT(there.rows(), 3 * here.rows() / 2);
  EXPECT_TRUE(there.allFinite());
  auto const rms = [](Eigen::MatrixXd const& signals) { return signals.norm() / std::sqrt(signals.size()); };
  EXPECT_NEAR(rms(there) / rms(here), 1.0, 0.2);
}

}  // namespace weights_elsewhere_test
