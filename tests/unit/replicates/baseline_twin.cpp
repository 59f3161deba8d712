// From a recording to its clean twin: loop, corrected baseline, disturbance.

#include "engine/infer/replicates/baseline_twin.hpp"
#include "engine/infer/pipeline/recording_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/infer/replicates/twin_batch.hpp"
#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace baseline_twin_test {

BaselineTwin made_from(Recording const& recording, RecordPipeline const& pipeline, std::uint64_t seed = 1,
                       int threads = 2) {
  return make_baseline_twin(recording, pipeline, clean_filter(), {1e-4, 16, seed, 0}, threads);
}

double rms(Eigen::VectorXd const& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

TEST(BaselineTwin, TakesTheBiasOutOfTheBaseline) {
  // a coarse encoder and little torque noise: bias, not noise, is what least squares is wrong by
  constexpr int records = 8;
  auto joint = clean_joint();
  joint.plan.noise.torque_std = 0.002;
  joint.plan.encoder.counts_per_revolution = 40000.0;
  Eigen::MatrixXd before(records, 4), after(records, 4), std(records, 4);
  for (int i = 0; i < records; ++i) {
    Recording recording = recorded(simulate_joint(joint.plan, 500 + static_cast<std::uint64_t>(i)));
    recording.rows.encoder_step *= 10.0;
    auto const pipeline = clean_pipeline(recording);
    auto const made = made_from(recording, pipeline, static_cast<std::uint64_t>(i));
    EXPECT_LE(made.baseline.rounds, 6);
    before.row(i) = made.baseline.least_squares - joint.truth;
    after.row(i) = made.baseline.parameters - joint.truth;
    std.row(i) = made.baseline.std;
  }
  Eigen::ArrayXd const sigma = std.colwise().mean().transpose();
  Eigen::ArrayXd const bias_before = before.colwise().mean().transpose().array() / sigma;
  Eigen::ArrayXd const bias_after = after.colwise().mean().transpose().array() / sigma;
  for (Eigen::Index k = 0; k < 4; ++k)
    RecordProperty("bias_in_sigma_" + std::to_string(k),
                   std::to_string(bias_before[k]) + " to " + std::to_string(bias_after[k]));
  // inertia and Coulomb friction were wrong by more than a standard deviation; nothing is by one
  EXPECT_GT(std::abs(bias_before[0]), 1.0);
  EXPECT_GT(std::abs(bias_before[2]), 1.0);
  EXPECT_LT(bias_after.abs().maxCoeff(), 1.0);
}

// wherever it starts: replicates of what it returns give the recording's fit, seen by the torque of the difference
TEST(BaselineTwin, ReplicatesOfTheCorrectedJointGiveTheFitOfTheRecording) {
  auto joint = clean_joint();
  joint.plan.encoder.counts_per_revolution = 40000.0;
  auto const recording = recorded(simulate_joint(joint.plan, 21));
  auto const pipeline = clean_pipeline(recording);
  auto const made = made_from(recording, pipeline);
  ProcessedRecord const& record = made.record;
  constexpr std::size_t twins = 16;
  TwinAddress const address{1, 0, 0};
  for (double const share : {0.8, 1.0, 1.2}) {
    BaselineCorrection const found = correct_baseline(record, share * record.parameters, made.loop.loop,
                                                      made.loop.track, pipeline, 1e-4, address, twins, 2);
    ASSERT_FALSE(found.ran_away);
    Eigen::MatrixXd fits(twins, 4);
    CleanTwin const twin(pipeline.model().twin_joint(found.parameters), made.loop.loop, made.loop.track, 1e-4);
    for_each_twin(twin, pipeline, address, twins, 2, [&](VisitedTwin const& visited) {
      fits.row(static_cast<Eigen::Index>(visited.index)) = visited.record.parameters;
    });
    Eigen::RowVectorXd const mean = fits.colwise().mean();
    double scatter = 0.0;
    for (Eigen::Index i = 0; i < fits.rows(); ++i)
      scatter += (record.columns * (fits.row(i) - mean).transpose()).squaredNorm() / (twins - 1.0);
    double const off = (record.columns * (record.parameters - mean.transpose())).norm() / std::sqrt(scatter);
    EXPECT_LT(off, 0.2) << "from " << share << " of the fit, after " << found.rounds << " rounds";
    EXPECT_TRUE(found.converged);
  }
}

TEST(BaselineTwin, FindsNoDisturbanceWhereThereIsNone) {
  auto const recording = recorded(simulate_joint(clean_joint().plan, 12));
  auto const pipeline = clean_pipeline(recording);
  auto const made = made_from(recording, pipeline);
  EXPECT_EQ(made.loop.source, LoopSource::identified);
  EXPECT_TRUE(made.baseline.converged);
  EXPECT_EQ(made.disturbance.std, 0.0) << made.disturbance.z;
  EXPECT_NEAR(made.disturbance.ratio, 1.0, 0.2);
}

TEST(BaselineTwin, FindsTheLevelOfADisturbance) {
  auto joint = clean_joint();
  double const level = 0.05;
  joint.plan.noise.disturbance_std = level;
  auto const recording = recorded(simulate_joint(joint.plan, 12));
  auto const pipeline = clean_pipeline(recording);
  auto const made = made_from(recording, pipeline);
  double const variance = made.disturbance.std * made.disturbance.std;
  EXPECT_GT(made.disturbance.z, 5.0);
  EXPECT_LT(made.disturbance.variance_error, 0.2 * level * level);
  EXPECT_LT(std::abs(variance - level * level), 3.0 * made.disturbance.variance_error);
}

TEST(BaselineTwin, FollowsARecordingThatHasNoReference) {
  auto recording = recorded(simulate_joint(clean_joint().plan, 12));
  recording.reference.resize(0);
  auto const pipeline = clean_pipeline(recording);
  auto const made = made_from(recording, pipeline);
  EXPECT_EQ(made.loop.source, LoopSource::tracking);
  EXPECT_FALSE(made.loop.controller);
  EXPECT_FALSE(made.loop.remark.empty());
  TwinGroup group;
  made.twin.simulate({1, 0, first_free_twin_set}, 0, group);
  // friction of 1.3 N m against a stiffness of J omega^2 = 1280 N m/rad
  EXPECT_LT(rms(group.position[0] - recording.position), 2.0 * 1.3 / 1280.0);
}

// what a stiff controller makes of its encoder is loud at the highest frequencies alone, where the noise of a torque is
// read that no law tells
TEST(BaselineTwin, ThatFollowsAMotionIsNoLouderThanARecordingWhoseTorqueRattles) {
  Recording rattling = recorded(simulate_joint(clean_joint().plan, 12));
  for (Eigen::Index i = 0; i < rattling.torque.size(); ++i) rattling.torque[i] += i % 2 == 0 ? 0.3 : -0.3;
  auto const pipeline = clean_pipeline(rattling);
  TwinOptions options{1e-4, 16, 1, 0};
  auto const joint = clean_joint().truth;
  options.loop = std::make_shared<RecordedLoop const>(
      tracking_loop(rattling, {joint[0], joint[1], joint[2] + joint[3], joint[3] - joint[2]}, clean_filter()));
  ASSERT_GT(options.loop->loop.torque_noise.std, 0.1);
  auto const made = make_baseline_twin(rattling, pipeline, clean_filter(), options, 2);
  EXPECT_TRUE(made.colour.has_value());
  EXPECT_GT(made.disturbance.z, -4.0);
  EXPECT_LT(made.twin.loop().torque_noise.std, 0.1);
}

TEST(BaselineTwin, HasTheSameBitsForAnyNumberOfThreads) {
  auto const recording = recorded(simulate_joint(clean_joint().plan, 12));
  auto const pipeline = clean_pipeline(recording);
  auto const one = made_from(recording, pipeline, 1, 1), four = made_from(recording, pipeline, 1, 4);
  EXPECT_EQ(one.baseline.parameters, four.baseline.parameters);
  EXPECT_EQ(one.disturbance.z, four.disturbance.z);

  constexpr std::size_t twins = 20;
  Eigen::VectorXd alone(twins), together(twins);
  for_each_twin(one.twin, pipeline, {1, 0, 5}, twins, 1, [&](VisitedTwin const& visited) {
    alone[static_cast<Eigen::Index>(visited.index)] = visited.record.energy();
  });
  for_each_twin(four.twin, pipeline, {1, 0, 5}, twins, 4, [&](VisitedTwin const& visited) {
    together[static_cast<Eigen::Index>(visited.index)] = visited.record.energy();
  });
  EXPECT_EQ(alone, together);
}

TEST(BaselineTwin, IsNotAskedOfATorqueOfTheWrongSignWhoseWorkTellsIt) {
  auto recording = recorded(simulate_joint(clean_joint().plan, 12));
  auto const pipeline = clean_pipeline(recording);
  EXPECT_FALSE(check_sign(pipeline.process(recording)));
  recording.torque = -recording.torque;
  auto const refused = check_sign(pipeline.process(recording));
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->verdict, Verdict::data_fault);
  EXPECT_NE(refused->way_out.find("wrong sign"), std::string::npos);
}

TEST(BaselineTwin, BlamesTheMissingReferenceBeforeTheTorque) {
  // a torque that is noise beside what the motion asks for: whatever joint is fitted, leading it takes far more
  auto recording = recorded(simulate_joint(clean_joint().plan, 12));
  recording.reference.resize(0);
  for (Eigen::Index k = 0; k < recording.position.size(); ++k) {
    recording.torque[k] *= 1e-3;
    recording.position[k] += k % 2 == 0 ? 0.05 : -0.05;
  }
  auto const pipeline = clean_pipeline(recording);
  try {
    made_from(recording, pipeline);
    FAIL() << "a joint was led along a motion that its torque never made";
  } catch (Error const& error) {
    EXPECT_NE(error.problems().front().what.find("no reference was recorded"), std::string::npos)
        << error.problems().front().what;
  }
}

TEST(BaselineTwin, FollowsAMotionThatEndsInMidMove) {
  // what a filter makes of the last sample's speed is an acceleration of many times the recording's own
  auto recording = recorded(simulate_joint(clean_joint().plan, 12));
  recording.reference.resize(0);
  Eigen::Index fast = recording.position.size() * 3 / 4;
  auto const step = [&](Eigen::Index k) { return std::abs(recording.position[k] - recording.position[k - 1]); };
  for (Eigen::Index k = fast; k < recording.position.size(); ++k)
    if (step(k) > step(fast)) fast = k;
  Eigen::Index const n = fast + 1;
  for (Eigen::VectorXd* channel : {&recording.time_s, &recording.position, &recording.torque})
    *channel = channel->head(n).eval();
  Eigen::VectorXd const r = tracking_loop(recording, {0.036}, clean_filter()).track.reference;
  ASSERT_EQ(r.size(), n);
  Eigen::ArrayXd const bend = (r.tail(n - 2) - 2.0 * r.segment(1, n - 2) + r.head(n - 2)).array().abs();
  constexpr Eigen::Index end = 20;
  EXPECT_LE(bend.tail(end).maxCoeff(), bend.head(n - 2 - 10 * end).maxCoeff());
}

}  // namespace baseline_twin_test
