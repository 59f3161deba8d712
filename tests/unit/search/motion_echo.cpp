// Noise of whatever colour does not answer to the motion; what swings behind the joint does.

#include "engine/search/motion_echo.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "unit/twin/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace motion_echo_test {

constexpr double follows_p = 0.005;  // what doubt_noise() asks for
constexpr std::size_t twins = 200;   // the fewest whose p can be that small
// noise of the torque channel: stronger than its white part at a few hertz
constexpr double slow_std = 0.02, corner_hz = 8.0;

ModelStage stage_of(Recording const& recording) {
  FilterOptions const filter = clean_filter();
  Section const section{};
  return make_stage({recording, clean_regressor(), filter, section, twins, 1, 2}, clean_regressor()).value();
}

// What a mass that swings at `hertz` behind the joint does to it: the acceleration, through a memory of its own
Eigen::VectorXd swing(Eigen::VectorXd const& acceleration, double hertz, double damping, double rate_hz) {
  double const omega = 2.0 * std::numbers::pi * hertz, step = 1.0 / rate_hz;
  Eigen::VectorXd torque(acceleration.size());
  double angle = 0.0, speed = 0.0;
  for (Eigen::Index k = 0; k < torque.size(); ++k) {
    torque[k] = -omega * omega * angle - 2.0 * damping * omega * speed;
    speed += step * (torque[k] - acceleration[k]);
    angle += step * speed;
  }
  return torque;
}

// what the pipeline sees of a signal in the torque, beside the model
Eigen::VectorXd on_rows(ModelStage const& stage, Eigen::VectorXd const& signal) {
  auto const& common = stage.comparison.common;
  Eigen::MatrixXd seen = stage.pipeline->filtered_columns(signal, common);
  stage.pipeline->whiten(seen, common.kept_rows);
  CandidateColumns const columns(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters());
  return seen - columns.nuisance() * (columns.nuisance().transpose() * seen);
}

TEST(MotionEcho, OfWhiteNoiseIsAnyOfItsTwins) {
  constexpr std::uint32_t records = 20;
  double mean = 0.0, least = 1.0;
  for (std::uint32_t i = 0; i < records; ++i) {
    auto joint = clean_joint();
    joint.plan.simulation.duration_s = 4.0;
    Recording const recording = recorded(simulate_joint(joint.plan, 100 + i));
    double const p = motion_echo_p(stage_of(recording));
    mean += p / records;
    least = std::min(least, p);
  }
  // of uniform ones: three standard errors of the mean, and a least one that happens once in 200 such sets
  EXPECT_NEAR(mean, 0.5, 3.0 * std::sqrt(1.0 / 12.0 / records));
  EXPECT_GT(least, 0.005 / records);
}

TEST(MotionEcho, IsNotHeardInNoiseThatHasAMemory) {
  for (std::uint32_t i = 0; i < 8; ++i) {
    Recording const clean = recorded(simulate_joint(clean_joint().plan, 300 + i));
    Recording const recording = without_reference(clean, slow_std, corner_hz, i);
    EXPECT_GT(motion_echo_p(stage_of(recording)), follows_p) << i;
  }
}

TEST(MotionEcho, IsHeardOfWhatSwingsBehindTheJoint) {
  Recording const clean = recorded(simulate_joint(clean_joint().plan, 300));
  Recording const recording = without_reference(clean, slow_std, corner_hz, 0);
  ModelStage stage = stage_of(recording);
  ASSERT_GT(motion_echo_p(stage), follows_p);
  auto& rows = stage.comparison.rows;
  Eigen::VectorXd const noise = rows.residual;
  for (double const hertz : {3.0, 8.0}) {
    Motion const& motion = stage.comparison.common.motion;
    Eigen::VectorXd const echo = on_rows(stage, swing(motion.ddq, hertz, 0.1, motion.rate_hz));
    // as loud as the noise
    rows.residual = noise + echo * (noise.norm() / echo.norm());
    EXPECT_LT(motion_echo_p(stage), follows_p) << hertz << " Hz";
  }
}

}  // namespace motion_echo_test
