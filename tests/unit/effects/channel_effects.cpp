// What happens to the torque on its way to the file.

#include <gtest/gtest.h>

#include <cmath>

#include "unit/effects/smooth_motion.hpp"

namespace torquescope {
namespace channel_effects_test {

JointScales const plain;

// torque channel of n samples: columns of an effect on it
Eigen::MatrixXd channel_columns(std::string const& name, Eigen::VectorXd const& torque, double rate_hz,
                                std::vector<double> const& shape) {
  auto const motion = test::motion_of(test::smooth_state, torque.size(), rate_hz);
  EffectInput const input{motion, plain, {}, {torque.data(), static_cast<std::size_t>(torque.size())}};
  return test::columns_of(*find_effect(name), input, shape);
}

TEST(Delay, OfARampIsExact) {
  constexpr double slope = 3.0, rate_hz = 1000.0;
  Eigen::VectorXd const ramp = slope * Eigen::VectorXd::LinSpaced(500, 0.0, 0.499);
  for (double const span_s : {0.0004, 0.0063, 0.03}) {
    auto const column = channel_columns("delay", ramp, rate_hz, {span_s});
    for (Eigen::Index i = 40; i < 500; ++i) ASSERT_NEAR(column(i, 0), -slope, 1e-9) << span_s;
  }
}

TEST(Delay, WithItsSpanAsDelayIsTheDelayedTorque) {
  constexpr double rate_hz = 1000.0, delay_s = 0.012;
  auto const torque_at = [](double t) { return std::sin(20.0 * t) + 0.3 * std::cos(55.0 * t); };
  Eigen::VectorXd torque(2000);
  for (Eigen::Index i = 0; i < 2000; ++i) torque[i] = torque_at(static_cast<double>(i) / rate_hz);
  auto const column = channel_columns("delay", torque, rate_hz, {delay_s});
  for (Eigen::Index i = 12; i < 2000; ++i)
    ASSERT_NEAR(torque[i] + delay_s * column(i, 0), torque_at(static_cast<double>(i) / rate_hz - delay_s), 1e-12);
}

TEST(ActuatorLag, UndoesTheLagOfTheMotor) {
  // command = true + lag * d true/dt: columns from the true torque and runner from the command must agree
  constexpr double rate_hz = 20000.0, lag_s = 0.004;
  auto const true_at = [](double t) { return 1.0 + std::sin(20.0 * t) + 0.3 * std::cos(55.0 * t); };
  auto const slope_at = [](double t) { return 20.0 * std::cos(20.0 * t) - 16.5 * std::sin(55.0 * t); };
  Eigen::VectorXd torque(10000);
  for (Eigen::Index i = 0; i < 10000; ++i) torque[i] = true_at(static_cast<double>(i) / rate_hz);
  auto const column = channel_columns("actuator_lag", torque, rate_hz, {});
  auto const runner = find_effect("actuator_lag")->runner(std::vector<double>{lag_s}, plain);
  for (Eigen::Index i = 0; i < 10000; ++i) {
    double const t = static_cast<double>(i) / rate_hz;
    double const command = true_at(t) + lag_s * slope_at(t);
    double const missing = runner->torque({.time_s = t, .motor_torque = command}, i > 0 ? 1.0 / rate_hz : 0.0);
    // after the start is forgotten; central differences and straight lines: (55 rad/s / 20 kHz)^2
    if (t < 0.1 || i == 9999) continue;
    ASSERT_NEAR(missing, lag_s * column(i, 0), 1e-5 * lag_s * 36.5) << t;
  }
}

TEST(Clipping, InFullMakesFlatTops) {
  Eigen::Vector4d const torque(0.4, 1.7, -2.0, -0.9);
  auto const column = channel_columns("clipping", torque, 10.0, {1.0, 1.0});
  EXPECT_EQ((torque + column), Eigen::Vector4d(0.4, 1.0, -1.0, -0.9));
}

TEST(Clipping, HasALimitForEitherSide) {
  Eigen::Vector4d const torque(0.4, 1.7, -2.0, -0.9);
  auto const column = channel_columns("clipping", torque, 10.0, {1.5, 0.5});
  EXPECT_EQ((torque + column), Eigen::Vector4d(0.4, 1.5, -0.5, -0.5));
}

TEST(TorqueConstant, IsCubicInTheTorque) {
  Eigen::Vector3d const torque(0.5, -1.0, 2.0);
  EXPECT_EQ(channel_columns("torque_constant", torque, 10.0, {}), Eigen::Vector3d(0.125, -1.0, 8.0));
}

// what is recorded is what the motor gives and the column of that; more of the one is more of the other, whatever beta
TEST(TorqueConstant, TellsASimulatorWhatItsColumnSaysOfTheTorqueThatIsGiven) {
  for (double const beta : {0.0, 0.01, 0.5, 20.0}) {
    auto const runner = find_effect("torque_constant")->runner(std::vector<double>{beta}, {});
    for (double const given : {-3.0, -0.2, 0.0, 0.7, 2.5}) {
      double const missing = beta * given * given * given;
      EXPECT_NEAR(runner->torque({.motor_torque = given + missing}), missing, 1e-9 * (1.0 + std::abs(missing)));
    }
  }
}

TEST(SensorDrift, IsARampAndAStepWhateverTheMotion) {
  auto const columns = channel_columns("sensor_drift", Eigen::VectorXd::Zero(101), 10.0, {4.0});
  EXPECT_NEAR(columns(100, 0), 10.0, 1e-12);
  EXPECT_EQ(columns.col(1).sum(), 61.0);
  EXPECT_EQ(columns(39, 1), 0.0);
  EXPECT_EQ(columns(40, 1), 1.0);
}

TEST(MeasurementEffects, AreToldApartFromPhysics) {
  for (auto const* name : {"delay", "clipping", "sensor_drift"})
    EXPECT_EQ(find_effect(name)->acts_on(), ActsOn::recorded_torque) << name;
  for (auto const* name : {"stribeck", "backlash", "actuator_lag", "contact", "torque_ripple"})
    EXPECT_EQ(find_effect(name)->acts_on(), ActsOn::joint) << name;
}

}  // namespace channel_effects_test
}  // namespace torquescope
