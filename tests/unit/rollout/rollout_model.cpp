// A vector of parameters is a joint in its loop; what could not be one is no trial, and its sums are infinite.

#include "engine/simulate/rollout/rollout_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.hpp"
#include "unit/rollout/recorded_joints.hpp"

using namespace torquescope;
using namespace torquescope::test;
using testing::ElementsAre;
using testing::HasSubstr;

namespace rollout_model_test {

RolloutModel model(std::vector<ModelEffect> const& effects = {}) {
  LoopSetting loop;
  loop.form = LoopForm::pd;
  loop.values[LoopKey::kp] = 18.0;
  loop.values[LoopKey::kd] = 1.1;
  loop.free = {LoopKey::kd, LoopKey::torque_delay_s};
  return {Regressor({"inertia", "viscous", "coulomb_positive", "coulomb_negative", "gravity"}, JointKind::revolute),
          Eigen::VectorXd::LinSpaced(6, 0.1, 0.6), JointScales{}, effects, loop};
}

TEST(RolloutModel, NamesJointThenEffectsThenLoop) {
  EXPECT_THAT(model({{find_effect("cogging"), {{"cogging_order", 7.0}}}}).names(),
              ElementsAre("inertia", "viscous", "coulomb_positive", "coulomb_negative", "gravity_sin", "gravity_cos",
                          "cogging_cos", "cogging_sin", "cogging_order", "loop_kd", "loop_torque_delay_s"));
}

TEST(RolloutModel, PutsEveryParameterInItsPlace) {
  RolloutModel const made = model({{find_effect("cogging"), {{"cogging_order", 7.0}}}});
  Eigen::VectorXd parameters = made.start();
  EXPECT_EQ(parameters[8], 7.0);
  parameters << 0.05, 0.15, 0.3, -0.2, 0.8, -0.4, 0.2, 0.25, 9.0, 1.3, 0.004;
  RolloutTrial const trial = made.trial(parameters);
  EXPECT_TRUE(trial.is_possible);
  EXPECT_EQ(trial.joint.inertia, 0.05);
  EXPECT_EQ(trial.joint.viscous, 0.15);
  EXPECT_EQ(trial.forward, 0.3);
  EXPECT_EQ(trial.backward, -0.2);
  EXPECT_EQ(trial.joint.gravity_sin, 0.8);
  EXPECT_EQ(trial.joint.gravity_cos, -0.4);
  ASSERT_EQ(trial.effects.size(), 1u);
  EXPECT_THAT(trial.effects[0], ElementsAre(0.2, 0.25, 9.0));
  EXPECT_EQ(trial.loop.kp, 18.0);
  EXPECT_EQ(trial.loop.kd, 1.3);
  EXPECT_EQ(trial.loop.torque_delay_s, 0.004);
}

TEST(RolloutModel, OfWhatCannotBeAJointHasInfiniteSums) {
  RolloutModel const made = model();
  Eigen::VectorXd fine = made.start();
  fine << 0.05, 0.15, 0.3, -0.2, 0.0, 0.0, 1.1, 0.0;
  std::vector<RolloutTrack> const tracks{recorded(dry_joint(), controller_of("pd"), moved(400), {})};
  RolloutTask const task{tracks, {made.structure_for(fine, tracks[0].tick_s())}};
  struct {
    Eigen::Index which;
    double value;
  } const cases[] = {{0, 0.0}, {0, -0.05}, {2, -0.3}, {1, std::nan("")}};
  std::vector<RolloutTrial> trials{made.trial(fine)};
  for (auto const& [which, value] : cases) {
    Eigen::VectorXd changed = fine;
    changed[which] = value;
    trials.push_back(made.trial(changed));
    EXPECT_FALSE(trials.back().is_possible) << which;
  }
  auto const sums = sums_of_squares(task, trials, 1);
  EXPECT_EQ(sums[0], sums_of_squares(task, std::vector{trials[0]}, 1)[0]) << "nobody disturbs the one that can be";
  EXPECT_TRUE(std::isfinite(sums[0][0]) && std::isfinite(sums[0][1]));
  for (std::size_t i = 1; i < trials.size(); ++i)
    for (double const sum : sums[i]) EXPECT_TRUE(std::isinf(sum)) << i;
  // and all of them together
  auto const none = sums_of_squares(task, std::vector(trials.begin() + 1, trials.end()), 1);
  for (auto const& one : none) EXPECT_TRUE(std::isinf(one[0]));
}

TEST(RolloutModel, OfADivergedLoopHasInfiniteSums) {
  RolloutModel const made = model();
  Eigen::VectorXd fine = made.start(), wild = fine;
  fine << 0.05, 0.15, 0.3, -0.2, 0.0, 0.0, 1.1, 0.0;
  wild = fine;
  wild[6] = 300.0;
  std::vector<RolloutTrack> const tracks{recorded(dry_joint(), controller_of("pd"), moved(400), {})};
  RolloutTask const task{tracks, {made.structure_for(fine, tracks[0].tick_s())}};
  auto const sums = sums_of_squares(task, std::vector{made.trial(wild), made.trial(fine)}, 1);
  EXPECT_TRUE(std::isinf(sums[0][0]));
  EXPECT_TRUE(std::isinf(sums[0][1]));
  EXPECT_LT(sums[1][0], 1.0);
}

TEST(RolloutModel, StepsShortEnoughForItsJoint) {
  RolloutTrial trial;
  trial.joint = {0.05, 0.15, 0.0, 0.0};
  EXPECT_EQ(longest_step_s(trial, {}, 1e-3), 1e-3);
  trial.joint.viscous = 10.0;  // 200 1/s
  EXPECT_NEAR(longest_step_s(trial, {}, 1e-3), 1e-4, 1e-9);
  trial.joint = {0.001, 0.0, 40.0, 0.0};  // swings with 200 1/s
  EXPECT_NEAR(longest_step_s(trial, {}, 1e-3), 1e-4, 1e-9);
  RolloutStructure remembers;
  remembers.effects = {find_effect("presliding")};
  trial.joint = {0.05, 0.15, 0.0, 0.0};
  EXPECT_NEAR(longest_step_s(trial, remembers, 1e-3), 5e-4, 1e-9);
}

TEST(RolloutModel, RefusesTwoParametersOfOneName) {
  try {
    model({{find_effect("viscous"), {}}});
    FAIL();
  } catch (Error const& error) {
    EXPECT_EQ(error.problems()[0].code, ExitCode::bad_job);
    EXPECT_THAT(error.problems()[0].what, HasSubstr("viscous"));
    EXPECT_FALSE(error.problems()[0].help.empty());
  }
  // two waves of one kind are told apart
  auto const names = model({{find_effect("cogging"), {}}, {find_effect("cogging"), {}}}).names();
  EXPECT_THAT(names, testing::Contains("cogging_order_2"));
}

}  // namespace rollout_model_test
