// Torques of an arm that come late: found at their joint, with their time, and only where they explain half.

#include "engine/diagnose/arms/torque_delay.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/diagnose/arms/filtered_arm.hpp"
#include "engine/infer/pipeline/arm_reversals.hpp"
#include "engine/robot/inverse_dynamics.hpp"
#include "unit/arms/setup_samples.hpp"

namespace torquescope {
namespace torque_delay_test {

constexpr double rate_hz = 200.0;
constexpr Eigen::Index n = 6000;

class TorqueDelays : public testing::Test {
 protected:
  // a joint's torque is late by late_s[j]; noise: of the torque's size
  LaggedGrams grams(std::vector<double> const& late_s, double noise) const {
    std::mt19937 random(7);
    std::normal_distribution<double> white(0.0, 1.0);
    RecordedArm arm;
    arm.joints.resize(4);
    Eigen::MatrixXd torque(n, 4);
    Eigen::VectorXd const time = Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1) / rate_hz);
    for (std::size_t j = 0; j < 4; ++j) {
      Recording& one = arm.joints[j];
      one.name = "a.csv";
      one.rate_hz = rate_hz;
      one.time_s = time;
      one.position.resize(n);
      one.torque.resize(n);
      for (Eigen::Index i = 0; i < n; ++i) {
        one.position[i] = at(time[i]).q[static_cast<Eigen::Index>(j)];
        one.torque[i] = torque_at(time[i] - late_s[j])[static_cast<Eigen::Index>(j)];
      }
      double const size = std::sqrt(one.torque.squaredNorm() / static_cast<double>(n));
      for (Eigen::Index i = 0; i < n; ++i) one.torque[i] += noise * size * white(random);
    }
    ArmModel const model(chain, ArmTerms{{"viscous", "coulomb", "offset"}}, section);
    auto const motion = motion_of(arm, {options, section});
    LaggedGrams made;
    made.add(model, motion, rows_of(model, arm, motion, {options, section}),
             ParallelFilter(options, rate_hz, n, section));
    return made;
  }

  struct State {
    Eigen::VectorXd q{Eigen::VectorXd(4)}, dq{Eigen::VectorXd(4)}, ddq{Eigen::VectorXd(4)};
  };
  static State at(double t) {
    State now;
    for (Eigen::Index j = 0; j < 4; ++j) {
      auto const number = static_cast<double>(j + 1);
      double const slow = 0.7 + 0.31 * number, fast = 2.1 + 0.47 * number;
      now.q[j] = 0.8 * std::sin(slow * t + number) + 0.3 * std::sin(fast * t);
      now.dq[j] = 0.8 * slow * std::cos(slow * t + number) + 0.3 * fast * std::cos(fast * t);
      now.ddq[j] = -0.8 * slow * slow * std::sin(slow * t + number) - 0.3 * fast * fast * std::sin(fast * t);
    }
    return now;
  }
  Eigen::VectorXd torque_at(double t) const {
    State const now = at(t);
    return inverse_dynamics(chain, standard, now.q, now.dq, now.ddq) + 0.4 * now.dq +
           0.5 * now.dq.array().sign().matrix();
  }

  SerialChain chain = test::small_arm(true);
  Eigen::VectorXd standard = standard_parameters(chain, DriveInertias::included);
  Section section{};
  FilterOptions options = [] {
    FilterOptions one;
    one.cutoff_hz = 20.0;
    one.parallel_cutoff_hz = 8.0;
    one.decimate_to_hz = 40.0;
    return one;
  }();
};

TEST_F(TorqueDelays, OfASoundArmAreNone) { EXPECT_TRUE(find_torque_delays(grams({0, 0, 0, 0}, 0.02)).empty()); }

TEST_F(TorqueDelays, OfUpToASampleAreNoFault) { EXPECT_TRUE(find_torque_delays(grams({0, 0.005, 0, 0}, 0.0)).empty()); }

TEST_F(TorqueDelays, StandAtTheirJointsWithTheirTimes) {
  auto const found = find_torque_delays(grams({0, 0.028, 0, -0.017}, 0.01));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].joint, 1U);
  EXPECT_NEAR(found[0].seconds, 0.028, 0.001);
  EXPECT_EQ(found[1].joint, 3U);
  EXPECT_NEAR(found[1].seconds, -0.017, 0.001);
  EXPECT_LT(found[0].after, 0.5 * found[0].before);
}

TEST_F(TorqueDelays, BelowTheNoiseAreNotTold) { EXPECT_TRUE(find_torque_delays(grams({0, 0.012, 0, 0}, 0.5)).empty()); }

}  // namespace torque_delay_test
}  // namespace torquescope
