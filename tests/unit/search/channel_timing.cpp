// A torque channel that was read beside its row is put back in time, whichever way and however far.

#include "engine/infer/search/channel_timing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/infer/pipeline/held_torque.hpp"
#include "unit/replicates/clean_records.hpp"

namespace torquescope {
namespace channel_timing_test {

Recording sine_read_late(double late_s) {
  Recording recording;
  recording.rate_hz = 1000.0;
  recording.time_s = Eigen::VectorXd::LinSpaced(2001, 0.0, 2.0);
  recording.torque = (2.0 * M_PI * 3.0 * (recording.time_s.array() - late_s)).sin();
  return recording;
}

TEST(ChannelTiming, PutsTheTorqueBackInTimeWhicheverWayItWasRead) {
  Recording const true_one = sine_read_late(0.0);
  for (double late_s : {0.5e-3, -0.5e-3, 0.2e-3, -0.6e-3, 1.0e-3, 1.3e-3, -2.1e-3}) {
    Recording const earlier = with_torque_earlier(sine_read_late(late_s), late_s);
    // the samples at the ends have no neighbour on one side
    constexpr Eigen::Index ends = 12;
    Eigen::Index const n = true_one.torque.size() - 2 * ends;
    double const curvature = 0.125 * std::pow(2.0 * M_PI * 3.0 * 1e-3, 2);
    EXPECT_LE((earlier.torque - true_one.torque).segment(ends, n).cwiseAbs().maxCoeff(), 1.01 * curvature) << late_s;
    EXPECT_EQ(earlier.torque.size(), true_one.torque.size());
  }
}

// of a joint of an arm the torque is without its gear load, but it was read with it
TEST(ChannelTiming, MovesWhatWasTakenOutOfTheTorqueWithIt) {
  Recording read = sine_read_late(0.5e-3);
  Recording whole = read;
  read.gear_load = (7.0 * read.time_s.array()).cos();
  whole.torque = read.torque + torque_to_hold(read.gear_load);
  Eigen::VectorXd const earlier = with_torque_earlier(read, 0.5e-3).torque;
  EXPECT_LE(
      (earlier + torque_to_hold(read.gear_load) - with_torque_earlier(whole, 0.5e-3).torque).cwiseAbs().maxCoeff(),
      1e-13);
  EXPECT_GT((earlier - with_torque_earlier(sine_read_late(0.5e-3), 0.5e-3).torque).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(ChannelTiming, TakesNoNoiseAwayAndNoLevel) {
  Recording read = sine_read_late(0.0);
  read.torque.setConstant(0.7);
  EXPECT_LE((with_torque_earlier(read, 0.4e-3).torque.array() - 0.7).abs().maxCoeff(), 1e-14);
  std::mt19937 draw(5);
  std::normal_distribution<double> normal;
  for (double& value : read.torque) value = normal(draw);
  // half way between two samples straight lines would leave half of the variance; the window takes a tenth, near the
  // Nyquist frequency
  EXPECT_GT(with_torque_earlier(read, 0.5e-3).torque.squaredNorm(), 0.85 * read.torque.squaredNorm());
}

// a torque that a stiff controller writes follows every step of the encoder: between its rows it is nobody's answer
TEST(ChannelTiming, LosesTheLawOfAStiffControllerAndNoOther) {
  auto joint = test::clean_joint();
  joint.plan.encoder.counts_per_revolution = 0.1 * test::counts_per_revolution;
  joint.plan.noise.torque_std = 0.002;
  Recording const recording = test::recorded(simulate_joint(joint.plan, 12));
  EXPECT_TRUE(loses_the_law(recorded_loop(recording, {}, {}), with_torque_earlier(recording, 0.4e-3)));
  EXPECT_FALSE(loses_the_law(recorded_loop(recording, {}, {}), recording));
  joint.plan.controller.bandwidth_hz = 1.0;
  joint.plan.noise.torque_std = 0.02;
  Recording const slack = test::recorded(simulate_joint(joint.plan, 12));
  EXPECT_FALSE(loses_the_law(recorded_loop(slack, {}, {}), with_torque_earlier(slack, 0.4e-3)));
  Recording unknown = recording;
  unknown.reference.resize(0);
  EXPECT_FALSE(loses_the_law(recorded_loop(unknown, {}, {}), with_torque_earlier(unknown, 0.4e-3)));
}

// what a stage without any late torque leaves is no delay; half a sample is told, within a tenth of one
TEST(LateTorque, IsTheTimeWithinARowThatTheTorqueWasReadAt) {
  auto joint = test::clean_joint();
  joint.plan.noise.torque_std = 0.001;
  Recording const in_time = test::recorded(simulate_joint(joint.plan, 4));
  FilterOptions const filter = test::clean_filter();
  Section const section{};
  for (double late_s : {0.0, 0.5e-3}) {
    Recording const recording = with_torque_earlier(in_time, -late_s);
    StageSetting const setting{recording, test::clean_regressor(), filter, section, 64, 1, 2};
    ModelStage const stage = make_stage(setting, test::clean_regressor()).value();
    CandidateColumns const columns(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters());
    auto const found = late_torque(stage, columns, recording.rate_hz);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->late_s, late_s, 0.1e-3);
    EXPECT_EQ(found->z > 4.0, late_s > 0.0) << found->z;
    EXPECT_EQ(found->gain > 0.1 * stage.mismatch().squaredNorm(), late_s > 0.0)
        << found->gain << " of " << stage.mismatch().squaredNorm() << " z " << found->z << " late " << found->late_s;
  }
}

TEST(ChannelTiming, IsAnyTimeAfterTheRowAndHalvesBeforeIt) {
  constexpr double surely_z = 50.0;
  auto const rows_late = [&](double rows, double z, double already = 0.0) {
    return is_timing({rows * 1e-3, z}, already * 1e-3, 1000.0);
  };
  for (double rows : {0.1, 0.3, 0.5, 1.0, -0.05, -0.45, -0.5, -0.95, -1.0})
    EXPECT_TRUE(rows_late(rows, surely_z)) << rows;
  for (double rows : {1.3, 2.0, -0.3, -0.7, -1.3, -1.7, -2.0}) EXPECT_FALSE(rows_late(rows, surely_z)) << rows;
  EXPECT_TRUE(rows_late(-0.3, 2.0)) << "it may be half a row as well";
  EXPECT_TRUE(rows_late(-0.3, surely_z, -0.2)) << "half a row with what was taken out before";
  EXPECT_FALSE(rows_late(-0.3, surely_z, -0.4));
}

TEST(ChannelTiming, SaysWhatWasDone) {
  EXPECT_EQ(timing_remark(0.5e-3, 1000.0).substr(0, 36), "torque taken 0.5 ms earlier than its");
  EXPECT_EQ(timing_remark(-0.5e-3, 1000.0).substr(0, 34), "torque taken 0.5 ms later than its");
  EXPECT_EQ(timing_remark(0.0, 1000.0), "");
  std::string const late = timing_sentence(0.5e-3, 1000.0);
  EXPECT_EQ(late.substr(0, 56), "The torque comes 0.5 ms after its rows, 0.5 of a sample,") << late;
  EXPECT_NE(late.find("lower recording.delay_s by as much"), std::string::npos) << late;
  EXPECT_EQ(timing_sentence(0.0, 1000.0), "");
}

}  // namespace channel_timing_test
}  // namespace torquescope
