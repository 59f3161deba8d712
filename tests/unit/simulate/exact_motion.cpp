// Mode "inverse_dynamics".

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "engine/effects/regressor.hpp"
#include "engine/simulate/joint_simulation.hpp"
#include "support/decompositions.hpp"
#include "unit/simulate/plants.hpp"

using namespace torquescope;

namespace exact_motion_test {

// the study of the seed: 10 s at 200 Hz within the speed and acceleration of the CRS A465
SimulationPlan seed_plan() {
  SimulationPlan plan;
  plan.simulation.mode = "inverse_dynamics";
  plan.simulation.rate_hz = 200.0;
  plan.simulation.duration_s = 10.0;
  plan.plant = torquescope::test::seed_plant();
  return plan;
}

Motion motion_of(SimulatedRecording const& recording) {
  return {recording.rate_hz,           recording.time_s, recording.position, recording.true_velocity,
          recording.true_acceleration, recording.torque};
}

struct Fit {
  Eigen::VectorXd parameters;
  double mse;
};

// least squares by QR of the regressor that identification uses, not of the simulator's own columns
Fit least_squares(SimulatedRecording const& recording) {
  Regressor const regressor({"inertia", "viscous", "coulomb_positive", "coulomb_negative"}, JointKind::revolute);
  Eigen::MatrixXd const phi = regressor.columns(motion_of(recording));
  Eigen::VectorXd const parameters = test::least_squares(phi, recording.torque);
  double const n = static_cast<double>(phi.rows());
  return {parameters, (recording.torque - phi * parameters).squaredNorm() / n};
}

double const seed_parameters[] = {0.0036, 0.0164, 0.0089, -0.2582};

TEST(ExactMotion, LeastSquaresFindsTheParametersOfNoiselessData) {
  auto const fit = least_squares(simulate_joint(seed_plan(), 42));
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(fit.parameters[i] / seed_parameters[i], 1.0, 1e-13) << i;
  EXPECT_LT(fit.mse, 1e-30);
}

TEST(ExactMotion, OrthogonalNoiseGivesTheSeedsOwnRowAndError) {
  auto plan = seed_plan();
  plan.noise.orthogonal_mse = 0.09259;
  for (std::uint64_t seed : {1u, 42u, 20u}) {
    auto const recording = simulate_joint(plan, seed);
    ASSERT_EQ(recording.torque.size(), 2000);
    auto const fit = least_squares(recording);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(fit.parameters[i] / seed_parameters[i], 1.0, 1e-12) << i;
    EXPECT_NEAR(fit.mse / 0.09259, 1.0, 1e-12);
  }
}

TEST(ExactMotion, ValidationDataOfTheStudyHasNoiseOfTheSameSizeButNotOrthogonal) {
  auto plan = seed_plan();
  plan.noise.orthogonal_mse = 0.09259;
  auto const validation = simulate_joint(plan, 42, 1);
  double const mse = (validation.torque - validation.true_torque).squaredNorm() / 2000.0;
  EXPECT_NEAR(mse, 0.09259, 5.0 * 0.09259 * std::sqrt(2.0 / 2000.0));
  EXPECT_GT(std::abs(least_squares(validation).parameters[2] / seed_parameters[2] - 1.0), 1e-3);
}

TEST(ExactMotion, StaysWithinTheArmsLimitsAndUsesThem) {
  auto const recording = simulate_joint(seed_plan(), 42);
  EXPECT_LE(recording.true_velocity.cwiseAbs().maxCoeff(), 3.14);
  EXPECT_LE(recording.true_acceleration.cwiseAbs().maxCoeff(), 12.57);
  EXPECT_GT(recording.true_velocity.maxCoeff(), 1.5);
  EXPECT_LT(recording.true_velocity.minCoeff(), -1.5);
}

TEST(ExactMotion, TorqueNoiseHasTheStandardDeviationAskedFor) {
  auto plan = seed_plan();
  plan.simulation.duration_s = 100.0;
  plan.noise.torque_std = 0.3;
  plan.noise.torque_coloured_std = 0.4;
  plan.noise.torque_coloured_s = 0.01;
  auto const recording = simulate_joint(plan, 3);
  // 20000 samples, half as many independent ones at the least
  EXPECT_NEAR((recording.torque - recording.true_torque).squaredNorm() / 20000.0, 0.25,
              5.0 * 0.25 * std::sqrt(2.0 / 5000.0));
}

TEST(SimulatedRecording, IsTheSameWhateverWasSimulatedBefore) {
  auto plan = seed_plan();
  plan.noise.torque_std = 0.1;
  auto const first = simulate_joint(plan, 5);
  simulate_joint(plan, 6);
  simulate_joint(plan, 5, 1);
  auto const again = simulate_joint(plan, 5);
  EXPECT_EQ(first.sha256, again.sha256);
  EXPECT_EQ(first.torque, again.torque);
}

TEST(SimulatedRecording, WithoutItsTruthIsTheSameRecording) {
  auto plan = seed_plan();
  plan.noise.torque_std = 0.1;
  auto const whole = simulate_joint(plan, 5);
  auto const lean = simulate_joint(plan, 5, 0, TrueTorque::left_out);
  EXPECT_EQ(lean.true_torque.size(), 0);
  EXPECT_EQ(lean.torque, whole.torque);
  EXPECT_EQ(lean.sha256, whole.sha256);
}

TEST(SimulatedRecording, DigestSeesEveryChannel) {
  auto plan = seed_plan();
  auto const quiet = simulate_joint(plan, 5);
  plan.noise.torque_std = 1e-9;
  auto const noisy = simulate_joint(plan, 5);
  EXPECT_EQ(noisy.position, quiet.position);
  EXPECT_NE(noisy.sha256, quiet.sha256);
}

TEST(SimulatedRecording, DiffersBySeedAndIndex) {
  auto const plan = seed_plan();
  auto const here = simulate_joint(plan, 5);
  EXPECT_NE(here.sha256, simulate_joint(plan, 6).sha256);
  EXPECT_NE(here.sha256, simulate_joint(plan, 5, 1).sha256);
}

TEST(SimulatedRecording, TheJobsOwnSeedTakesPrecedence) {
  auto plan = seed_plan();
  auto const of_experiment = simulate_joint(plan, 9).sha256;
  plan.simulation.seed = 9;
  EXPECT_EQ(simulate_joint(plan, 1).sha256, of_experiment);
  EXPECT_EQ(simulate_joint(plan, 2).sha256, of_experiment);
}

TEST(SimulatedRecording, NamesItsColumnsAsAJobWould) {
  auto const recording = simulate_joint(seed_plan(), 5);
  std::vector<std::string> names, channels;
  for (auto const& column : columns(recording)) {
    names.push_back(column.name);
    channels.push_back(column.channel);
    EXPECT_EQ(column.values->size(), 2000);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"t_s", "q_ref_rad", "q_rad", "tau_Nm", "q_true_rad", "dq_rad_s",
                                             "ddq_rad_s2", "tau_true_Nm"}));
  EXPECT_EQ(channels,
            (std::vector<std::string>{"time", "reference", "position", "torque", "", "velocity", "acceleration", ""}));
}

}  // namespace exact_motion_test
