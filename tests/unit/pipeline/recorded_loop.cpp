// A joint that is fed by the recorded torque sticks as it did, and does not feel the encoder.

#include "engine/infer/pipeline/recorded_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/data/encoder_step.hpp"
#include "engine/simulate/replicate_simulator.hpp"
#include "unit/pipeline/clean_records.hpp"

using namespace torquescope;

namespace recorded_loop_test {

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
  ReplicateJoint const replicate = make_replicate_joint(test::clean_regressor(), joint.truth);
  auto const stands = [&](RecordedLoop const& loop) {
    ReplicateGroup group;
    ReplicateSimulator(replicate, loop.loop, loop.track, 1e-4).simulate({1, 0, 0}, 0, group);
    EXPECT_FALSE(group.ran_away[0]);
    return standing(group.position[0], step);
  };
  auto const& p = joint.truth;
  double const fed = stands(torque_fed_loop(recording, p[0], test::clean_filter()));
  double const led = stands(tracking_loop(recording, {p[0], p[1], p[2] + p[3], p[3] - p[2]}, test::clean_filter()));
  EXPECT_LT(std::abs(fed - recorded), 0.5 * std::abs(led - recorded)) << fed << " " << led << " " << recorded;
}

// the controller answers the joint's motion: where the encoder's steps lie changes readings and not the torque
TEST(RecordedLoop, FedByItsTorqueDoesNotFeelTheEncoder) {
  auto const joint = test::clean_joint();
  RecordedLoop fed =
      torque_fed_loop(test::recorded(simulate_joint(joint.plan, 5)), joint.truth[0], test::clean_filter());
  fed.loop.torque_noise = {};
  ReplicateJoint const replicate = make_replicate_joint(test::clean_regressor(), joint.truth);
  auto const torque = [&](double step) {
    fed.loop.encoder_step = step;
    fed.track.start_position = 0.0;
    ReplicateGroup group;
    ReplicateSimulator(replicate, fed.loop, fed.track, 1e-4).simulate({1, 0, 0}, 0, group);
    return group.torque[0];
  };
  Eigen::VectorXd const fine = torque(1e-12), coarse = torque(2e-4);
  // they begin within a step of each other, and the loop is slow
  EXPECT_LT((fine - coarse).norm(), 0.01 * fine.norm());
}

}  // namespace recorded_loop_test
