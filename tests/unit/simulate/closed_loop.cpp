// Mode "closed_loop".

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "engine/simulate/joint_simulation.hpp"
#include "support/decompositions.hpp"
#include "unit/simulate/plants.hpp"

using namespace torquescope;
using torquescope::test::plant;
using torquescope::test::seed_plant;

namespace closed_loop_test {

// a joint dominated by its friction: the torque of the inertia is 0.045 N m at most, friction up to 0.26
SimulationPlan crs_plan(std::string const& kind = "p_velocity") {
  SimulationPlan plan;
  plan.simulation.rate_hz = 200.0;
  plan.simulation.duration_s = 10.0;
  plan.plant = seed_plant();
  plan.controller.kind = kind;
  plan.controller.bandwidth_hz = 20.0;          // stiff enough that friction bends the path by 5 mrad only
  plan.encoder.counts_per_revolution = 400000;  // CRS A465: 1000 lines x 4 x gear 100
  return plan;
}

double rms(Eigen::VectorXd const& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

class EveryLoop : public testing::TestWithParam<std::string> {};

TEST_P(EveryLoop, TracksTheReferenceOfAFrictionDominatedJoint) {
  auto plan = crs_plan(GetParam());
  plan.controller.feedforward = true;
  auto const recording = simulate_joint(plan, 1);
  Eigen::VectorXd const error = recording.reference - recording.true_position;
  // proportional loops lean on friction: up to 0.31 N m / (57 N m / rad); the integral takes that away but at reversals
  EXPECT_LT(error.cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT(rms(error), GetParam() == "pid" ? 0.0015 : 0.006);
}

TEST_P(EveryLoop, UsesTheSpeedRangeInBothDirections) {
  auto const recording = simulate_joint(crs_plan(GetParam()), 1);
  EXPECT_GT(recording.true_velocity.maxCoeff(), 1.5);
  EXPECT_LT(recording.true_velocity.minCoeff(), -1.5);
  EXPECT_LT(recording.true_velocity.cwiseAbs().maxCoeff(), 3.5);
}

TEST_P(EveryLoop, ForgetsItsStart) {
  // stable: two loops that differ by one encoder step at the start end alike
  auto plan = crs_plan(GetParam());
  plan.encoder = {};
  auto const one = simulate_joint(plan, 1);
  plan.noise.position_std = 1e-9;
  auto const two = simulate_joint(plan, 1);
  EXPECT_LT((one.true_position - two.true_position).cwiseAbs().maxCoeff(), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(AllKinds, EveryLoop, testing::Values("p_velocity", "pd", "pid"),
                         [](auto const& tested) { return tested.param; });

TEST(ClosedLoop, TorqueIsThatOfTheTrueMotionWhileItMoves) {
  auto const recording = simulate_joint(crs_plan(), 4);
  JointPlant const joint(seed_plant());
  int moving = 0;
  for (Eigen::Index i = 0; i < recording.torque.size(); ++i) {
    JointState const state{recording.time_s[i], recording.true_position[i], recording.true_velocity[i],
                           recording.true_acceleration[i]};
    if (state.dq == 0.0) continue;
    ++moving;
    EXPECT_NEAR(recording.true_torque[i], joint.inverse_dynamics(state), 1e-14);
  }
  EXPECT_GT(moving, 1800);
}

TEST(ClosedLoop, LeastSquaresOnTheTrueMotionFindsTheParameters) {
  auto const recording = simulate_joint(crs_plan(), 5);
  Eigen::Index const n = recording.torque.size();
  Eigen::MatrixXd phi(n, 4);
  Eigen::VectorXd torque(n);
  Eigen::Index rows = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    double const dq = recording.true_velocity[i];
    if (dq == 0.0) continue;
    phi.row(rows) << recording.true_acceleration[i], dq, dq > 0.0, dq < 0.0;
    torque[rows++] = recording.torque[i];
  }
  Eigen::VectorXd const fit = test::least_squares(phi.topRows(rows), torque.head(rows));
  double const expected[] = {0.0036, 0.0164, 0.0089, -0.2582};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(fit[i] / expected[i], 1.0, 1e-9) << i;
}

TEST(ClosedLoop, HalvingTheIntegratorsStepChangesLittle) {
  // far below the encoder's half step of 8e-6 rad
  auto plan = crs_plan();
  plan.encoder = {};
  plan.simulation.step_s = 40e-6;
  auto const coarse = simulate_joint(plan, 1);
  plan.simulation.step_s = 20e-6;
  auto const middle = simulate_joint(plan, 1);
  plan.simulation.step_s = 10e-6;
  auto const fine = simulate_joint(plan, 1);
  double const first = rms(coarse.true_position - middle.true_position);
  double const second = rms(middle.true_position - fine.true_position);
  EXPECT_LT(second, 1e-8);
  EXPECT_LT(second, 0.5 * first);
}

TEST(ClosedLoop, PositionIsWithinHalfAnEncoderStep) {
  auto plan = crs_plan();
  plan.encoder.counts_per_revolution = 2000;
  auto const recording = simulate_joint(plan, 1);
  double const half_step = Encoder(plan.encoder).step() / 2.0;
  EXPECT_LE((recording.position - recording.true_position).cwiseAbs().maxCoeff(), half_step * (1.0 + 1e-9));
}

TEST(ClosedLoop, TorqueNoiseIsMeasuredButDoesNotAct) {
  auto plan = crs_plan();
  auto const quiet = simulate_joint(plan, 1);
  plan.noise.torque_std = 0.05;
  auto const noisy = simulate_joint(plan, 1);
  EXPECT_EQ(quiet.true_position, noisy.true_position);
  EXPECT_NEAR(rms(noisy.torque - quiet.torque), 0.05, 5.0 * 0.05 / std::sqrt(2.0 * 2000.0));
}

TEST(ClosedLoop, DisturbanceActsButIsNotMeasured) {
  auto plan = crs_plan();
  auto const quiet = simulate_joint(plan, 1);
  plan.noise.disturbance_std = 0.05;
  plan.noise.disturbance_s = 0.02;
  auto const disturbed = simulate_joint(plan, 1);
  EXPECT_GT(rms(disturbed.true_position - quiet.true_position), 1e-5);
  EXPECT_NEAR(rms(disturbed.true_torque - disturbed.torque), 0.05, 0.01);
}

TEST(ClosedLoop, PositionNoiseHasTheStandardDeviationAskedFor) {
  auto plan = crs_plan();
  plan.encoder = {};
  plan.noise.position_std = 2e-5;
  auto const recording = simulate_joint(plan, 1);
  EXPECT_NEAR(rms(recording.position - recording.true_position), 2e-5, 5.0 * 2e-5 / std::sqrt(2.0 * 2000.0));
}

TEST(ClosedLoop, SaturatesAtTheMotorsLimit) {
  auto plan = crs_plan();
  plan.controller.torque_limit = 0.27;
  auto const recording = simulate_joint(plan, 1);
  EXPECT_LE(recording.torque.cwiseAbs().maxCoeff(), 0.27);
  EXPECT_GT(recording.saturated_samples, 0);
  plan.controller.torque_limit = 0.0;
  EXPECT_EQ(simulate_joint(plan, 1).saturated_samples, 0);
}

TEST(ClosedLoop, AveragedTorqueHasNoHalfTickOfLead) {
  // viscous joint: torque is the velocity's shadow; its shift against the exact torque is the log's lead
  auto plan = crs_plan();
  plan.plant = plant({{"inertia", 0.0036}, {"viscous", 0.0164}});
  plan.encoder = {};
  auto const lead_s = [&](std::string const& log) {
    plan.controller.torque_log = log;
    auto const recording = simulate_joint(plan, 2);
    // exact torque of the smooth motion, and its derivative by differences
    Eigen::Index const n = recording.torque.size();
    JointPlant const joint(plan.plant);
    Eigen::VectorXd exact(n - 2), slope(n - 2), logged = recording.torque.segment(1, n - 2);
    double const dt = 1.0 / recording.rate_hz;
    for (Eigen::Index i = 1; i + 1 < n; ++i) {
      double const dq = recording.true_velocity[i];
      double const ddq = (recording.true_velocity[i + 1] - recording.true_velocity[i - 1]) / (2.0 * dt);
      double const dddq = (recording.true_velocity[i + 1] - 2.0 * dq + recording.true_velocity[i - 1]) / (dt * dt);
      exact[i - 1] = 0.0036 * ddq + 0.0164 * dq;
      slope[i - 1] = 0.0036 * dddq + 0.0164 * ddq;
    }
    return slope.dot(logged - exact) / slope.squaredNorm();
  };
  EXPECT_NEAR(lead_s("applied"), 0.0005, 5e-5);  // half of 1 ms
  EXPECT_NEAR(lead_s("averaged"), 0.0, 5e-5);
}

TEST(ClosedLoop, StandsStillOnceTheReferenceDoes) {
  // a trapezoid with long dwells: friction holds the joint at the end of a stroke, exactly
  auto plan = crs_plan("pd");
  plan.reference.kind = "trapezoid";
  plan.reference.amplitude = 0.5;
  plan.reference.speeds = {1.0};
  plan.reference.dwell_s = 1.0;
  auto const recording = simulate_joint(plan, 1);
  int resting = 0;
  for (Eigen::Index i = 0; i < recording.torque.size(); ++i) resting += recording.true_velocity[i] == 0.0;
  EXPECT_GT(resting, 600);
}

TEST(ClosedLoop, RunawayIsAnErrorWithACure) {
  auto plan = crs_plan("pd");
  plan.controller.kp = 5000.0;
  plan.controller.kd = 100.0;
  plan.controller.delay_ticks = 5;
  try {
    simulate_joint(plan, 1);
    FAIL() << "an unstable loop was recorded";
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_job);
    EXPECT_FALSE(error.problems()[0].help.empty());
  }
}

TEST(ClosedLoop, GivesTheSameBitsWhateverWasSimulatedBefore) {
  auto plan = crs_plan();
  plan.noise = {0.05, 0.02, 0.05, 1e-6, 0.01, 0.05, 0.0};
  auto const first = simulate_joint(plan, 8);
  simulate_joint(plan, 9, 1);
  EXPECT_EQ(simulate_joint(plan, 8).sha256, first.sha256);
  EXPECT_NE(simulate_joint(plan, 9).sha256, first.sha256);
  EXPECT_EQ(first.sha256.size(), 64u);
}

}  // namespace closed_loop_test
