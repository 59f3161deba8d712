#include "engine/simulate/arm_simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.hpp"
#include "engine/robot/base_parameters.hpp"
#include "unit/simulate/arms.hpp"

namespace torquescope {
namespace arm_simulation_test {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd at_sample(SimulatedArm const& arm, VectorXd SimulatedRecording::*channel, Index i) {
  VectorXd values(static_cast<Index>(arm.joints.size()));
  for (std::size_t j = 0; j < arm.joints.size(); ++j) values[static_cast<Index>(j)] = (arm.joints[j].*channel)[i];
  return values;
}

TEST(ArmSimulation, TorqueIsWhatItsMotionNeeds) {
  auto const plan = test::arm_plan();
  auto const arm = simulate_arm(plan, 1);
  ArmPlant plant = test::arm_plant(plan.chain, {{"viscous", 0.4}, {"coulomb", 0.3}, {"offset", 0.05}});
  double furthest = 0.0;
  int moving = 0;
  for (Index i = 0; i < arm.joints[0].time_s.size(); ++i) {
    VectorXd const q = at_sample(arm, &SimulatedRecording::true_position, i),
                   dq = at_sample(arm, &SimulatedRecording::true_velocity, i),
                   ddq = at_sample(arm, &SimulatedRecording::true_acceleration, i),
                   torque = at_sample(arm, &SimulatedRecording::torque, i);
    furthest = std::max(furthest, (at_sample(arm, &SimulatedRecording::reference, i) - q).cwiseAbs().maxCoeff());
    if (dq.cwiseAbs().minCoeff() == 0.0) continue;
    ++moving;
    VectorXd const needed = plant.inverse_dynamics({0.0, q, dq}, ddq);
    EXPECT_LT((torque - needed).norm(), 1e-9 * needed.norm()) << i;
  }
  EXPECT_GT(moving, 150);
  EXPECT_LT(furthest, 0.1);  // it follows its reference
}

TEST(ArmSimulation, ExactMotionHasTheTorqueOfTheRegressor) {
  auto plan = test::arm_plan();
  plan.simulation.mode = "inverse_dynamics";
  for (auto& joint : plan.joints) joint.terms = {};
  auto const arm = simulate_arm(plan, 1);
  auto const chi = standard_parameters(plan.chain, DriveInertias::included);
  for (Index i = 0; i < arm.joints[0].time_s.size(); i += 7) {
    VectorXd const q = at_sample(arm, &SimulatedRecording::position, i),
                   dq = at_sample(arm, &SimulatedRecording::true_velocity, i),
                   ddq = at_sample(arm, &SimulatedRecording::true_acceleration, i);
    VectorXd const needed = arm_regressor(plan.chain, q, dq, ddq, DriveInertias::included) * chi;
    EXPECT_LT((at_sample(arm, &SimulatedRecording::torque, i) - needed).norm(), 1e-12 * needed.norm()) << i;
  }
}

TEST(ArmSimulation, ComputedTorqueFollowsCloser) {
  auto plan = test::arm_plan();
  auto const distance = [&] {
    auto const arm = simulate_arm(plan, 1);
    double far = 0.0;
    for (auto const& joint : arm.joints)
      far = std::max(far, (joint.reference - joint.true_position).cwiseAbs().maxCoeff());
    return far;
  };
  double const without = distance();
  for (auto& joint : plan.joints) joint.controller.feedforward = true;
  EXPECT_LT(distance(), 0.2 * without);
}

TEST(ArmSimulation, SameBitsOnAnyNumberOfThreads) {
  auto plan = test::arm_plan();
  for (auto& joint : plan.joints) joint.noise = {.torque_std = 0.1, .position_std = 1e-5, .disturbance_std = 0.05};
  auto const digests = [&](int threads) {
    std::vector<std::string> made(4);
    parallel_for(made.size(), threads, [&](std::size_t k, int) {
      made[k] = simulate_arm(plan, 11 + k / 2, static_cast<std::uint32_t>(k % 2)).sha256;
    });
    return made;
  };
  auto const one = digests(1);
  EXPECT_EQ(one, digests(2));
  EXPECT_EQ(one, digests(4));
  // every record has a motion and noise of its own
  auto sorted = one;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(std::unique(sorted.begin(), sorted.end()), sorted.end());
}

TEST(ArmSimulation, JointsHaveNoiseOfTheirOwn) {
  auto plan = test::arm_plan();
  plan.simulation.mode = "inverse_dynamics";
  auto const clean = simulate_arm(plan, 1);
  for (auto& joint : plan.joints) joint.noise.torque_std = 0.1;
  auto const noisy = simulate_arm(plan, 1);
  VectorXd const first = noisy.joints[0].torque - clean.joints[0].torque,
                 second = noisy.joints[1].torque - clean.joints[1].torque;
  double const n = static_cast<double>(first.size());
  EXPECT_NEAR(first.squaredNorm() / n, 0.01, 4.0 * 0.01 * std::sqrt(2.0 / n));
  EXPECT_LT(std::abs(first.dot(second)) / (first.norm() * second.norm()), 4.0 / std::sqrt(n));
}

TEST(ArmSimulation, EncodersShowSteps) {
  auto plan = test::arm_plan();
  plan.joints[1].encoder.step = 1e-3;
  auto const arm = simulate_arm(plan, 1);
  VectorXd const steps = arm.joints[1].position / 1e-3;
  for (Index i = 0; i < steps.size(); ++i) EXPECT_NEAR(steps[i], std::round(steps[i]), 1e-9);
}

TEST(ArmSimulation, ColumnsCarryTheJointsNumber) {
  auto const arm = simulate_arm(test::arm_plan(), 1);
  auto const table = columns(arm);
  std::vector<std::string> names;
  for (auto const& column : table) names.push_back(column.name);
  for (char const* name :
       {"t_s", "q1_rad", "q_ref2_rad", "tau2_Nm", "q_true1_rad", "dq_true1_rad_s", "ddq_true2_rad_s2", "tau_true1_Nm"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
}

TEST(ArmSimulation, TruthNamesBaseParametersAndFriction) {
  auto const plan = test::arm_plan();
  BaseParameters const base(plan.chain, DriveInertias::included);
  auto const truth = truth_values(plan);
  ASSERT_EQ(truth.size(), static_cast<std::size_t>(base.size()) + 3 * plan.joints.size());
  EXPECT_EQ(truth[0].name, base.parameters()[0].name);
  EXPECT_EQ(truth[static_cast<std::size_t>(base.size())].name, "viscous_1");
  EXPECT_EQ(truth[static_cast<std::size_t>(base.size())].value, 0.4);
}

TEST(ArmSimulation, ALoopThatRunsAwayIsTold) {
  auto plan = test::arm_plan();
  plan.simulation.duration_s = 20.0;
  for (auto& joint : plan.joints) joint.controller.delay_ticks = 60;
  EXPECT_THROW(simulate_arm(plan, 1), Error);
}

}  // namespace arm_simulation_test
}  // namespace torquescope
