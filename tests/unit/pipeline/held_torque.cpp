// A torque that holds between samples, put beside the motion of its samples.

#include "engine/infer/pipeline/held_torque.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random_stream.hpp"
#include "support/decompositions.hpp"

using namespace torquescope;

namespace held_torque_test {

constexpr Eigen::Index n = 400;

template <typename Function>
Eigen::VectorXd sampled(Function const& function) {
  Eigen::VectorXd values(n);
  for (Eigen::Index k = 0; k < n; ++k) values[k] = function(static_cast<double>(k));
  return values;
}

// without the rows at the ends that stay as read, of both ways
auto inner(Eigen::VectorXd const& values) { return values.segment(4, n - 8); }

TEST(HeldTorque, ActsAsTheMeanOfTheSampleBeforeUpToCubics) {
  auto const cubic = [](double t) { return 2.0 - 0.3 * t + 0.02 * t * t - 1e-4 * t * t * t; };
  auto const antiderivative = [](double t) {
    return 2.0 * t - 0.15 * t * t + 0.02 / 3.0 * t * t * t - 2.5e-5 * t * t * t * t;
  };
  Eigen::VectorXd const mean = sampled([&](double t) { return antiderivative(t) - antiderivative(t - 1.0); });
  EXPECT_LT(inner(acting_torque(sampled(cubic)) - mean).cwiseAbs().maxCoeff(), 1e-9 * mean.cwiseAbs().maxCoeff());
}

TEST(HeldTorque, OneWayUndoesTheOtherUpToCubics) {
  Eigen::VectorXd const torque = sampled([](double t) { return 2.0 - 0.3 * t + 0.02 * t * t - 1e-4 * t * t * t; });
  double const rounding = 1e-12 * torque.cwiseAbs().maxCoeff();
  EXPECT_LT(inner(acting_torque(torque_to_hold(torque)) - torque).cwiseAbs().maxCoeff(), rounding);
  EXPECT_LT(inner(torque_to_hold(acting_torque(torque)) - torque).cwiseAbs().maxCoeff(), rounding);
}

// a free mass of 1 kg that is moved exactly, a row at a time; what its samples say about the acceleration at a row is
// that of the wave through them
TEST(HeldTorque, IsWhatAMassNeedsAtTheInstantOfASample) {
  RandomStream stream({7, 1, RandomDomain::test}, 0, 0);
  for (int record = 0; record < 20; ++record) {
    double const omega = 6.283185307179586 / stream.uniform(20.0, 100.0), phase = stream.uniform(0.0, 6.0);
    Eigen::VectorXd const held = sampled([&](double t) { return std::sin(omega * t + phase); });
    Eigen::VectorXd position = Eigen::VectorXd::Zero(n);
    double velocity = 0.0;
    for (Eigen::Index k = 1; k < n; ++k) {
      position[k] = position[k - 1] + velocity + 0.5 * held[k - 1];
      velocity += held[k - 1];
    }
    Eigen::MatrixXd waves(n, 4);
    waves << Eigen::VectorXd::Ones(n), Eigen::VectorXd::LinSpaced(n, -1.0, 1.0),
        sampled([&](double t) { return std::sin(omega * t); }), sampled([&](double t) { return std::cos(omega * t); });
    Eigen::VectorXd const found = test::least_squares(waves, position);
    ASSERT_LT((waves * found - position).norm(), 1e-9 * position.norm()) << "nothing but a wave and a drift";
    Eigen::VectorXd const needed = -omega * omega * waves.rightCols(2) * found.tail(2);
    double const as_read = inner(held - needed).norm(), acting = inner(acting_torque(held) - needed).norm();
    EXPECT_LT(acting, 0.02 * as_read) << omega;
  }
}

TEST(HeldTorque, LeavesWhatIsShorterThanFourRowsAsItIs) {
  Eigen::VectorXd const three = Eigen::Vector3d(1.0, 2.0, 4.0);
  EXPECT_EQ(acting_torque(three), three);
  EXPECT_EQ(torque_to_hold(three), three);
  EXPECT_EQ(acting_torque(Eigen::VectorXd()).size(), 0);
}

}  // namespace held_torque_test
