// The loop of a real recording, where it is at hand (tests/support/recordings_folder.hpp); whose limit a limit of the
// torque is.

#include "engine/infer/pipeline/recorded_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "engine/data/encoder_step.hpp"
#include "engine/data/health/make_recording.hpp"
#include "engine/data/recording_reader.hpp"
#include "engine/infer/pipeline/needed_torque.hpp"
#include "engine/simulate/clean_twin.hpp"
#include "support/recordings_folder.hpp"
#include "unit/replicates/clean_records.hpp"

using namespace torquescope;

namespace recorded_loop_test {

constexpr double newton_per_volt = 35.15065;
// published: u = kv (kp (q_ref - q) - dq), in V
constexpr double kp = 160.18, kv = 243.45;

std::filesystem::path emps(std::string const& name) { return test::recordings_folder() / "emps" / name; }

Recording read(std::filesystem::path const& path) {
  Section section;
  section.name = "recording";
  RecordingOptions options;
  options.columns = {{"time", "t_s"}, {"reference", "q_ref_m"}, {"position", "q_m"}, {"torque", "u_V"}};
  options.torque_per_unit = {newton_per_volt};
  return make_recording(read_table(path, section), options, section);
}

// peaks of its torque are for its inertia
test::CleanJoint limited_joint() { return test::clean_joint(0.08, 0.3, 0.3); }
// some of the torque that it needs
double limit_of(test::CleanJoint const& joint) { return 0.85 * simulate_joint(joint.plan, 5).torque.maxCoeff(); }

// the torque that is needed by a model which was fitted to the record as it is
RecordedLoop loop_of(Recording const& recording) {
  RecordPipeline const pipeline(test::clean_regressor(), test::clean_filter(), recording.rate_hz,
                                recording.position.size());
  ProcessedRecord const record = pipeline.process(recording);
  return recorded_loop(recording, {record.parameters[0]}, test::clean_filter(),
                       [&](auto const& limited) { return needed_torque(record, pipeline, limited); });
}

TEST(RecordedLoop, KeepsTheLimitOfADriveThatGaveNoMore) {
  auto joint = limited_joint();
  double const limit = limit_of(joint);
  joint.plan.controller.torque_limit = limit;
  auto const simulated = simulate_joint(joint.plan, 5);
  ASSERT_GT(simulated.saturated_samples, 100);
  auto const found = loop_of(test::recorded(simulated));
  EXPECT_NEAR(found.loop.law.most, limit, 0.02 * limit);
  EXPECT_NEAR(found.loop.law.least, -limit, 0.02 * limit);
}

TEST(RecordedLoop, HasNoLimitWhereOnlyTheRecordHasOne) {
  auto const joint = limited_joint();
  Recording recording = test::recorded(simulate_joint(joint.plan, 5));
  double const limit = 0.7 * recording.torque.maxCoeff();
  ASSERT_GT((recording.torque.array() > limit).count(), 100);
  recording.torque = recording.torque.cwiseMin(limit).cwiseMax(-limit);
  // without a model nobody can tell
  EXPECT_NEAR(recorded_loop(recording, {joint.truth[0]}, test::clean_filter()).loop.law.most, limit, 0.02 * limit);
  auto const found = loop_of(recording);
  EXPECT_NEAR(found.controller->law.most, limit, 0.02 * limit);
  EXPECT_TRUE(std::isinf(found.loop.law.most) && std::isinf(found.loop.law.least));
}

TEST(RecordedLoop, HasNoLimitOnTheOneSideThatIsCut) {
  auto const joint = limited_joint();
  Recording recording = test::recorded(simulate_joint(joint.plan, 5));
  double const limit = limit_of(joint);
  recording.torque = recording.torque.cwiseMax(-limit);
  auto const found = loop_of(recording);
  EXPECT_NEAR(found.controller->law.least, -limit, 0.02 * limit);
  EXPECT_TRUE(std::isinf(found.controller->law.most));
  EXPECT_TRUE(std::isinf(found.loop.law.least));
}

// a model that explains little of a recording needs more along its motion than was recorded
TEST(RecordedLoop, LetsALedJointHaveTheTorqueThatItsOwnModelNeeds) {
  auto const simulated = simulate_joint(limited_joint().plan, 5);
  auto recording = test::recorded(simulated);
  recording.torque *= 0.01;
  double const most_recorded = recording.torque.cwiseAbs().maxCoeff();
  TrackedJoint const joint{0.08, 0.3, 0.3, -0.3};
  // beside a reference such a torque is another signal or unit, and twins that run away say so
  EXPECT_DOUBLE_EQ(tracking_loop(recording, joint, test::clean_filter()).track.largest_torque, 3.0 * most_recorded);
  recording.reference.resize(0);
  double const needed = simulated.true_torque.cwiseAbs().maxCoeff();
  double const least_allowed = 2.0 * needed;  // of thrice; smoothing takes off peaks
  EXPECT_GT(tracking_loop(recording, joint, test::clean_filter()).track.largest_torque, least_allowed);
}

// at an arm's joint the law is known less well, and the drive gives more than the joint's own torque
TEST(RecordedLoop, LetsAJointOfAnArmHaveTheTorqueOfItsDrive) {
  auto recording = test::recorded(simulate_joint(limited_joint().plan, 5));
  TrackedJoint const joint{0.08, 0.3, 0.3, -0.3};
  double const own = tracking_loop(recording, joint, test::clean_filter()).track.largest_torque;
  recording.gear_load = Eigen::VectorXd::Constant(recording.torque.size(), 40.0);
  RecordedLoop const led = tracking_loop(recording, joint, test::clean_filter());
  EXPECT_NEAR(led.track.largest_torque, 3.0 * (recording.torque.array() + 40.0).abs().maxCoeff(), 1e-9);
  EXPECT_GT(led.track.largest_torque, own + 100.0);
  EXPECT_EQ(led.track.gear_load.size(), 0) << "a loop of our own gives the joint's own torque alone";
  // its law is one of the whole torque
  RecordedLoop const found = recorded_loop(recording, joint, test::clean_filter());
  EXPECT_EQ(found.track.gear_load.size(), recording.torque.size());
}

// a simulator beside a single joint leaves a gear load as well, but nothing of other joints
TEST(RecordedLoop, OfASingleJointWithASimulatorIsNoJointOfAnArm) {
  auto recording = test::recorded(simulate_joint(limited_joint().plan, 5));
  recording.torque *= 0.01;
  recording.gear_load = Eigen::VectorXd::Constant(recording.torque.size(), 0.5);
  TrackedJoint const joint{0.08, 0.3, 0.3, -0.3};
  double const most_given = 3.0 * (recording.torque.array() + 0.5).abs().maxCoeff();
  EXPECT_NEAR(tracking_loop(recording, joint, test::clean_filter()).track.largest_torque, most_given, 1e-9);
  recording.given = std::make_shared<GivenSignals const>();
  EXPECT_GT(tracking_loop(recording, joint, test::clean_filter()).track.largest_torque, 1.5 * most_given);
}

TEST(RecordedLoop, OfEmpsIsThePublishedController) {
  auto const path = emps("emps_train.csv.gz");
  SKIP_WITHOUT(path);
  auto const recording = read(path);
  FilterOptions filter;
  filter.cutoff_hz = 100.0;
  auto const found = recorded_loop(recording, {95.0}, filter);
  ASSERT_TRUE(found.controller);
  EXPECT_GT(found.controller->r_squared, 0.99999);
  EXPECT_NEAR(found.loop.law.proportional_gain() / (kp * kv * newton_per_volt), 1.0, 1e-3);
  EXPECT_NEAR(found.loop.law.velocity_gain(recording.rate_hz) / (kv * newton_per_volt), 1.0, 0.01);
  EXPECT_EQ(found.loop.law.integral, 0.0);
  // the velocity loop has an encoder of its own: its rounding is not in the recorded position, so the remainder is
  // small but not white, and says so
  EXPECT_EQ(found.source, LoopSource::approximated);
  EXPECT_LT(found.loop.torque_noise.std, 0.005 * newton_per_volt);
}

// share of the samples at which the joint stands for 10 ms
double standing(Eigen::VectorXd const& position, double step) {
  constexpr Eigen::Index wait = 10;
  Eigen::Index count = 0;
  for (Eigen::Index k = 0; k + wait < position.size(); ++k)
    count += std::abs(position[k + wait] - position[k]) <= step ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(position.size());
}

TEST(RecordedLoop, FedByItsTorqueStandsAtReversalsAsLongAsRecorded) {
  auto joint = test::clean_joint();
  joint.plan.controller.bandwidth_hz = 4.0;
  Recording const recording = test::recorded(simulate_joint(joint.plan, 5));
  double const step = encoder_step(recording), recorded = standing(recording.position, step);
  ASSERT_GT(recorded, 0.03);
  TwinJoint const twin = make_twin_joint(test::clean_regressor(), joint.truth);
  auto const stands = [&](RecordedLoop const& loop) {
    TwinGroup group;
    CleanTwin(twin, loop.loop, loop.track, 1e-4).simulate({1, 0, 0}, 0, group);
    EXPECT_FALSE(group.ran_away[0]);
    return standing(group.position[0], step);
  };
  auto const& p = joint.truth;
  double const fed = stands(torque_fed_loop(recording, p[0], test::clean_filter()));
  double const led = stands(tracking_loop(recording, {p[0], p[1], p[2] + p[3], p[3] - p[2]}, test::clean_filter()));
  EXPECT_LT(std::abs(fed - recorded), 0.5 * std::abs(led - recorded)) << fed << " " << led << " " << recorded;
}

// the law answers the joint's motion: where the encoder's steps lie changes readings and not the torque
TEST(RecordedLoop, FedByItsTorqueDoesNotFeelTheEncoder) {
  auto const joint = test::clean_joint();
  RecordedLoop fed =
      torque_fed_loop(test::recorded(simulate_joint(joint.plan, 5)), joint.truth[0], test::clean_filter());
  fed.loop.torque_noise = {};
  TwinJoint const twin = make_twin_joint(test::clean_regressor(), joint.truth);
  auto const torque = [&](double step) {
    fed.loop.encoder_step = step;
    fed.track.start_position = 0.0;
    TwinGroup group;
    CleanTwin(twin, fed.loop, fed.track, 1e-4).simulate({1, 0, 0}, 0, group);
    return group.torque[0];
  };
  Eigen::VectorXd const fine = torque(1e-12), coarse = torque(2e-4);
  // they begin within a step of each other, and the loop is slow
  EXPECT_LT((fine - coarse).norm(), 0.01 * fine.norm());
}

TEST(RecordedLoop, OfEmpsWithPulsesIsNotTakenForALaw) {
  // forces were added behind the controller: no law of reference and position explains the logged torque
  auto const path = emps("emps_valid_pulses.csv.gz");
  SKIP_WITHOUT(path);
  FilterOptions filter;
  filter.cutoff_hz = 100.0;
  auto const found = recorded_loop(read(path), {95.0}, filter);
  EXPECT_EQ(found.source, LoopSource::approximated);
  auto const& acf = found.controller->residual_acf;
  // a tanh of the reference's velocity imitates most of the pulses; five times beyond what white noise could be is left
  EXPECT_GT(*std::max_element(acf.begin(), acf.end()), 5.0 * found.controller->white_bound);
}

}  // namespace recorded_loop_test
