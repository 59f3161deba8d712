// An arm told apart into joints: what is left to each is its own equation of motion, by an inverse dynamics that the
// columns of the fit share nothing with.

#include "engine/diagnose/arms/rigid_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/infer/pipeline/held_torque.hpp"
#include "engine/robot/inverse_dynamics.hpp"
#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace rigid_rows_test {

constexpr double viscous = 1.5, coulomb = 2.0;
FilterOptions const no_filter{};
Section const no_section{};

// sums of two sines, other ones for every joint and seed, with their exact derivatives as channels
RecordedArm moved(SerialChain const& chain, int seed, Eigen::Index still = -1) {
  constexpr Eigen::Index samples = 3000;
  constexpr double rate_hz = 200.0;
  RecordedArm arm;
  auto const joints = static_cast<Eigen::Index>(chain.joints.size());
  for (Eigen::Index j = 0; j < joints; ++j) {
    Recording joint;
    joint.name = "moved";
    joint.rate_hz = rate_hz;
    joint.time_s = Eigen::VectorXd::LinSpaced(samples, 0.0, (samples - 1) / rate_hz);
    auto const number = static_cast<double>(j + 1);
    double const slow = 0.7 + 0.31 * number + 0.05 * seed, fast = 2.1 + 0.47 * number - 0.11 * seed;
    Eigen::ArrayXd const t = joint.time_s.array();
    joint.position = 0.8 * (slow * t + number).sin() + 0.2 * (fast * t).sin();
    joint.velocity = 0.8 * slow * (slow * t + number).cos() + 0.2 * fast * (fast * t).cos();
    joint.acceleration = -0.8 * slow * slow * (slow * t + number).sin() - 0.2 * fast * fast * (fast * t).sin();
    joint.torque = Eigen::VectorXd::Zero(samples);
    if (j == still) {
      joint.position.setConstant(0.3);
      joint.velocity.setZero();
      joint.acceleration.setZero();
    }
    arm.joints.push_back(std::move(joint));
  }
  Eigen::VectorXd q(joints), dq(joints), ddq(joints);
  for (Eigen::Index i = 0; i < samples; ++i) {
    for (Eigen::Index j = 0; j < joints; ++j) {
      auto const& joint = arm.joints[static_cast<std::size_t>(j)];
      q[j] = joint.position[i];
      dq[j] = joint.velocity[i];
      ddq[j] = joint.acceleration[i];
    }
    Eigen::VectorXd const torque =
        inverse_dynamics(chain, standard_parameters(chain, DriveInertias::included), q, dq, ddq);
    for (Eigen::Index j = 0; j < joints; ++j)
      arm.joints[static_cast<std::size_t>(j)].torque[i] =
          torque[j] + viscous * dq[j] + coulomb * std::copysign(1.0, dq[j]);
  }
  return arm;
}

class RigidRows : public testing::Test {
 protected:
  SerialChain const chain = test::random_arm(3, true, true).chain;
  ArmModel const model{chain,
                       [] {
                         ArmTerms terms;
                         terms.friction = {"viscous", "coulomb"};
                         return terms;
                       }(),
                       no_section};
  ArmFilter const filter{no_filter, no_section};
};

TEST_F(RigidRows, LeaveEachJointItsInertiaAndFriction) {
  std::vector<RecordedArm> const train{moved(chain, 1)};
  FittedArm const fitted = fit_arm(model, train, filter);
  for (int seed : {1, 2}) {
    RecordedArm const other = moved(chain, seed);
    auto const alone = joints_alone(model, fitted, other, filter);
    ASSERT_EQ(alone.size(), model.joints());
    for (std::size_t j = 0; j < alone.size(); ++j) {
      auto const& joint = other.joints[j];
      Eigen::VectorXd const own = fitted.inertia[static_cast<Eigen::Index>(j)] * joint.acceleration +
                                  viscous * joint.velocity +
                                  coulomb * joint.velocity.unaryExpr([](double v) { return std::copysign(1.0, v); });
      Eigen::VectorXd const beside = joint.torque - own;
      double const size = joint.torque.norm();
      EXPECT_LT((alone[j].gear_load - beside).norm(), 1e-6 * size) << "joint " << j + 1 << ", motion " << seed;
      EXPECT_LT((joint.torque - torque_to_hold(beside) - alone[j].torque).norm(), 1e-6 * size) << "joint " << j + 1;
    }
  }
}

// what nothing tells of the arm is not asked of another recording with the same joint at rest either
TEST_F(RigidRows, PredictTheOthersWhereAJointStandsStill) {
  constexpr Eigen::Index still = 1;
  std::vector<RecordedArm> const train{moved(chain, 1, still)};
  FittedArm const fitted = fit_arm(model, train, filter);
  ASSERT_TRUE(fitted.parameters.allFinite());
  RecordedArm const other = moved(chain, 2, still);
  auto const alone = joints_alone(model, fitted, other, filter);
  for (std::size_t j = 0; j < alone.size(); ++j) {
    if (static_cast<Eigen::Index>(j) == still) continue;
    auto const& joint = other.joints[j];
    Eigen::VectorXd const own = fitted.inertia[static_cast<Eigen::Index>(j)] * joint.acceleration +
                                viscous * joint.velocity +
                                coulomb * joint.velocity.unaryExpr([](double v) { return std::copysign(1.0, v); });
    EXPECT_LT((alone[j].gear_load - (joint.torque - own)).norm(), 1e-4 * joint.torque.norm()) << "joint " << j + 1;
  }
}

TEST_F(RigidRows, KeepTheInertiaThatAJointHasOnAverage) {
  std::vector<RecordedArm> const train{moved(chain, 1), moved(chain, 2)};
  FittedArm const fitted = fit_arm(model, train, filter);
  EXPECT_GT(fitted.inertia.minCoeff(), 0.0);
  EXPECT_EQ(static_cast<std::size_t>(fitted.inertia.size()), model.joints());
  EXPECT_EQ(static_cast<std::size_t>(fitted.parameters.size()), model.size());
}

}  // namespace rigid_rows_test
}  // namespace torquescope
