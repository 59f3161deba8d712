// A floor is what a complete model would leave: never more than what the recording's own twins show, and where these
// are louder than the recording none is told.

#include "engine/infer/validation/unseen_floor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace unseen_floor_test {

class UnseenFloor : public testing::Test {
 protected:
  static Recording clean_recording(std::uint32_t index) {
    auto joint = clean_joint();
    joint.plan.controller.kind = "pid";
    return recorded(simulate_joint(joint.plan, index));
  }

  TwinErrors errors_in(RecordedLoop const& tried) const { return unseen_twin_errors(unseen, setting, stage, tried); }

  Recording recording = clean_recording(3), unseen = clean_recording(4);
  FilterOptions filter = clean_filter();
  Section section{};
  StageSetting setting{recording, clean_regressor(), filter, section, 32, 1, 1};
  ModelStage stage = make_stage(setting, clean_regressor()).value();
  RecordedLoop loop = recorded_loop(unseen, {}, {});
};

TEST_F(UnseenFloor, IsWhatACleanRecordingLeaves) {
  RecordPipeline const pipeline = pipeline_for(setting, unseen, stage.model());
  ProcessedRecord const record = pipeline.prepare(unseen);
  double const relerr = (record.torque - record.columns * stage.parameters()).norm() / record.torque.norm();
  TwinErrors const twins = errors_in(loop);
  EXPECT_LT(twins.least, twins.mean);
  EXPECT_NEAR(twins.mean / relerr, 1.0, 0.2);
  EXPECT_EQ(floor_below(1.1 * twins.mean, twins), twins.mean);
}

// at a reversal the filtered velocity has the sign of friction a few rows early or late
TEST_F(UnseenFloor, WithRowsAtReversalsIsWithoutWhatFiltersMakeOfThem) {
  RecordPipeline pipeline = pipeline_for(setting, unseen, stage.model());
  pipeline.keep_reversals();
  ProcessedRecord const record = pipeline.prepare(unseen);
  Eigen::VectorXd const left = record.torque - record.columns * stage.parameters();
  Eigen::VectorXd const artefact = processing_artefact(unseen, setting, stage, loop, record.kept_rows);
  ASSERT_EQ(artefact.size(), left.size());
  // the joint is complete: half and more of what is left is none of it
  EXPECT_LT((left - artefact).norm(), 0.7 * left.norm());
  double const relerr = (left - artefact).norm() / record.torque.norm();
  TwinErrors const twins = unseen_twin_errors(unseen, setting, stage, loop, {&record.kept_rows, true, {}});
  EXPECT_NEAR(twins.mean / relerr, 1.0, 0.2);
}

// a law that lacks something leaves a remainder that its twins have for noise
TEST_F(UnseenFloor, IsThatOfTheTrainingLawWhereTheOwnOneIsTooLoud) {
  double const right = errors_in(loop).mean;
  loop.loop.torque_noise = white(8.0 * loop.loop.torque_noise.std);
  TwinErrors const loud = errors_in(loop);
  EXPECT_GT(loud.least, 2.0 * right);
  EXPECT_TRUE(std::isnan(floor_below(right, loud)));
  RecordedLoop const borrowed = with_law_of(stage.twin->loop, loop);
  EXPECT_EQ(borrowed.track.reference, loop.track.reference);
  EXPECT_EQ(borrowed.loop.encoder_step, loop.loop.encoder_step);
  EXPECT_NEAR(errors_in(borrowed).mean / right, 1.0, 0.2);
}

TEST_F(UnseenFloor, IsUnknownWhereTwinsRunAway) { EXPECT_TRUE(std::isnan(floor_below(0.1, TwinErrors{}))); }

}  // namespace unseen_floor_test
