// The plant of arms obeys mechanics: two formulas agree, energy is kept, dry friction holds and never pushes, a name is
// its bits, a law is as large as its name says.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "concealed/noise.hpp"
#include "concealed_arms/arm_case.hpp"
#include "concealed_arms/dry_friction.hpp"
#include "concealed_arms/rigid_columns.hpp"

namespace concealed_arms {
namespace arm_laws_test {

Eigen::VectorXd drawn(int n, double most, concealed::Random& random) {
  return Eigen::VectorXd::NullaryExpr(n, [&] { return random.between(-most, most); });
}

// without friction and constant torque
Arm bare(Arm arm) {
  for (Link& link : arm.links) link.viscous = link.coulomb = link.offset_torque = 0.0;
  return arm;
}

// starts as the motion does and is then left alone
Plant passive(Arm const& arm) {
  Plant plant{.arm = arm};
  plant.controller.bandwidth_hz = plant.controller.weight_share = 0.0;
  return plant;
}

TEST(ArmPlant, InverseDynamicsByHandEqualMuJoCos) {
  concealed::Random random(1, "poses");
  Gravity const leaning = {1.0, -2.0, -9.0};
  for (std::string const name : {"crs", "seven"}) {
    Arm const arm = bare(drawn_arm(name, 3));
    MujocoArm simulated(arm, leaning);
    double worst = 0.0;
    for (int pose = 0; pose < 50; ++pose) {
      auto const q = drawn(arm.joints(), 3.0, random), v = drawn(arm.joints(), 3.0, random),
                 a = drawn(arm.joints(), 20.0, random);
      Eigen::VectorXd const by_hand = torque_columns(arm, leaning, q, v, a) * parameters(arm);
      worst = std::max(worst, (by_hand - simulated.inverse(q, v, a)).cwiseAbs().maxCoeff());
      simulated.update(q, v);
      Eigen::VectorXd const forward = simulated.mass() * a + simulated.bias();
      worst = std::max(worst, (by_hand - forward).cwiseAbs().maxCoeff());
    }
    constexpr double of_principal_axes = 1e-6;  // N m of hundreds: MuJoCo's iteration for them ends at 1e-8
    EXPECT_LT(worst, of_principal_axes) << name;
  }
}

TEST(ArmPlant, TorqueOfACleanRunIsInverseDynamicsAndFriction) {
  ArmCase const one = parse_case("clean:crs:11");
  ArmMotion const motion = drawn_motion(MotionKind::sines, one.plant.arm, one.seed, "train");
  ArmRun const run = run_loop(one.plant, motion);
  Eigen::VectorXd const chi = parameters(one.plant.arm);
  double worst = 0.0;
  int seen = 0;
  for (Eigen::Index row = 1; row < run.q.cols(); row += 7) {
    if (run.v.col(row).cwiseAbs().minCoeff() < 0.02) continue;  // no joint reverses within a step
    Eigen::VectorXd const needed =
        torque_columns(one.plant.arm, upright, run.q.col(row), run.v.col(row), run.a.col(row)) * chi;
    worst = std::max(worst, (needed - run.applied.col(row)).cwiseAbs().maxCoeff());
    ++seen;
  }
  EXPECT_GT(seen, 300);
  constexpr double of_the_step = 1e-3;  // N m, where noise is 0.08 to 0.6
  EXPECT_LT(worst, of_the_step);
}

double energy_drift(int steps_a_tick) {
  Plant const plant = passive(bare(nominal_arm("crs")));
  ArmMotion motion = drawn_motion(MotionKind::sines, plant.arm, 5, "train");
  for (auto* part : {&motion.q, &motion.v, &motion.a}) *part = part->leftCols(1000).eval();  // a second
  ArmRun const run = run_loop(plant, motion, steps_a_tick);
  MujocoArm arm(plant.arm, upright);
  double const begin = arm.energy(run.q.col(1), run.v.col(1));
  double worst = 0.0;
  for (Eigen::Index row = 1; row < run.q.cols(); ++row)
    worst = std::max(worst, std::abs(arm.energy(run.q.col(row), run.v.col(row)) - begin));
  return worst;
}

TEST(ArmPlant, AnArmThatFallsWithoutFrictionKeepsItsEnergyToTheSecondOrderOfTheStep) {
  double const coarse = energy_drift(4), fine = energy_drift(8);
  EXPECT_LT(coarse, 1e-3);  // J, of tens that go from weight to speed
  EXPECT_NEAR(coarse / fine, 4.0, 0.5);
}

TEST(ArmPlant, StandsWhereDryFrictionIsMoreThanItsWeight) {
  Arm arm = nominal_arm("crs");
  for (Link& link : arm.links) link.coulomb = 200.0;
  Plant const plant = passive(arm);
  ArmMotion motion = drawn_motion(MotionKind::sines, arm, 5, "train");
  motion.v.setZero();
  ArmRun const run = run_loop(plant, motion);
  EXPECT_EQ((run.q.colwise() - motion.q.col(0)).cwiseAbs().maxCoeff(), 0.0);
}

TEST(ArmPlant, DryFrictionHoldsBelowItsLevelAndResistsAtIt) {
  concealed::Random random(2, "friction");
  int resting = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::MatrixXd const root = Eigen::MatrixXd::NullaryExpr(5, 5, [&] { return random.between(-1.0, 1.0); });
    Eigen::MatrixXd const a = root * root.transpose() + Eigen::MatrixXd::Identity(5, 5);
    auto const r = drawn(5, 2.0, random), before = drawn(5, 1.0, random);
    Eigen::VectorXd const level = drawn(5, 1.0, random).cwiseAbs();
    Eigen::VectorXd const v = speeds_against_dry_friction(a, r, level, before), friction = r - a * v;
    for (int j = 0; j < 5; ++j) {
      EXPECT_LE(std::abs(friction[j]), level[j] + 1e-9);
      if (v[j] != 0.0) {
        EXPECT_NEAR(friction[j], std::copysign(level[j], v[j]), 1e-9);
      }
      resting += v[j] == 0.0;
    }
  }
  EXPECT_GT(resting, 100);
}

TEST(ArmPlant, AFinerStepIsTheSameRecording) {
  ArmCase one = parse_case("law:crs:2:load_dependent_friction:4:3");
  one.plant.law->size = 0.1;
  one.plant.controller.encoder = false;  // a step of the encoder earlier or later is no error
  ArmMotion const motion = drawn_motion(one.motion, one.plant.arm, one.seed, "train");
  ArmRun const coarse = run_loop(one.plant, motion), fine = run_loop(one.plant, motion, 16);
  for (int j = 0; j < one.plant.arm.joints(); ++j) {
    double const apart = std::sqrt((coarse.applied.row(j) - fine.applied.row(j)).array().square().mean());
    EXPECT_LT(apart, 0.05 * one.plant.arm.links[static_cast<std::size_t>(j)].noise) << j;
  }
}

// what spring and damper carry is what the links need where they are, and what the drive does not keep for itself
TEST(ArmPlant, AnElasticJointKeepsTheEnergyOfAnArmThatFalls) {
  Plant plant = passive(bare(nominal_arm("crs")));
  concealed::Random random(5, "law");
  plant.law = drawn_law(LawKind::elastic_joint, plant.arm, 1, {1.0, 1.0, 2.0}, random);
  plant.law->size = plant.law->largest;
  plant.law->shape = 0.0;  // no damper
  ArmMotion motion = drawn_motion(MotionKind::sines, plant.arm, 5, "train");
  for (auto* part : {&motion.q, &motion.v, &motion.a}) *part = part->leftCols(1000).eval();  // a second
  ArmRun const run = run_loop(plant, motion, 8);
  MujocoArm arm(plant.arm, upright);
  double const drive = plant.arm.links[1].drive_inertia;
  auto const energy = [&](Eigen::Index row) {
    Eigen::VectorXd const q = run.links_q.col(row), v = run.links_v.col(row);
    double const wound = run.q(1, row) - q[1];
    return arm.energy(q, v) + 0.5 * drive * (run.v(1, row) * run.v(1, row) - v[1] * v[1]) +
           0.5 * wound * wound / plant.law->size;
  };
  double worst = 0.0, most = 0.0;
  for (Eigen::Index row = 1; row < run.q.cols(); ++row) {
    worst = std::max(worst, std::abs(energy(row) - energy(1)));
    most = std::max(most, std::abs(run.q(1, row) - run.links_q(1, row)));
  }
  EXPECT_LT(worst, 1e-2);  // J, of tens that go from weight to speed
  EXPECT_GT(most, 1e-3);   // rad: it winds up
}

TEST(ArmCases, TheSameNameIsTheSameBits) {
  auto const one = make_case(parse_case("A1:3")), again = make_case(parse_case(spelled_out("A1:3")));
  EXPECT_EQ(one.of.folder, again.of.folder);
  EXPECT_TRUE(one.train.torque == again.train.torque);
  EXPECT_TRUE(one.validate.run.seen == again.validate.run.seen);
  EXPECT_FALSE(one.train.torque == one.validate.torque);
}

TEST(ArmCases, ALawIsAsLargeAsItsNameSaysAndACleanArmLeavesNothing) {
  for (auto const& [name, snr] : {std::pair{"law:crs:3:spring:2:21", 2.0}, {"law:crs:1:stribeck:4:22", 4.0}}) {
    auto const made = make_case(parse_case(name));
    EXPECT_NEAR(made.left.snr(made.of.plant.law->joint) / snr, 1.0, 0.1) << name;
  }
  EXPECT_LT(make_case(parse_case("clean:seven:23")).left.largest_snr(), 0.01);
}

TEST(ArmCases, EveryLawComesInEverySize) {
  std::set<std::string> drawn;
  for (std::size_t number = 1; number <= 4 * law_words().size(); ++number) {
    ArmCase const one = parse_case("A1:" + std::to_string(number));
    drawn.insert(std::to_string(static_cast<int>(one.plant.law->kind)) + " " + std::to_string(one.wanted_snr));
  }
  EXPECT_EQ(drawn.size(), 4 * law_words().size());
}

TEST(ArmCases, AZeroOfTheLastJointCannotBeTold) {
  EXPECT_THROW(parse_case("law:crs:5:joint_zero:1:1"), std::invalid_argument);
  EXPECT_THROW(parse_case("law:crs:6:spring:1:1"), std::invalid_argument);
  EXPECT_THROW(parse_case("A3:1"), std::invalid_argument);
}

}  // namespace arm_laws_test
}  // namespace concealed_arms
