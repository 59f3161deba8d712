#include "engine/simulate/controller.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace torquescope;

namespace controller_test {

ControllerOptions of_kind(std::string const& kind) {
  ControllerOptions options;
  options.kind = kind;
  options.velocity_cutoff_hz = 0.0;
  return options;
}

constexpr double rate_hz = 1000.0;

// position error of an ideal inertia, started a step away from a resting reference
double step_response(ControllerOptions const& options, double inertia, double duration_s) {
  constexpr double step_s = 1.0 / 10000.0;
  Controller controller(options, 10000.0, inertia, {});
  double q = 0.0, dq = 0.0;
  for (double t = 0.0; t < duration_s; t += step_s) {
    double const acceleration = controller.command({1.0, 0.0, 0.0}, q) / inertia;
    q += step_s * (dq + 0.5 * step_s * acceleration);
    dq += step_s * acceleration;
  }
  return 1.0 - q;
}

class EveryController : public testing::TestWithParam<std::string> {};

TEST_P(EveryController, IsSilentOnItsReference) {
  Controller controller(of_kind(GetParam()), rate_hz, 0.1, {0.4, 0.0, 0.0});
  for (int tick = 0; tick < 20; ++tick) EXPECT_EQ(controller.command({0.4, 0.0, 0.0}, 0.4), 0.0);
}

TEST_P(EveryController, PushesTowardsTheReference) {
  Controller controller(of_kind(GetParam()), rate_hz, 0.1, {});
  EXPECT_GT(controller.command({1.0, 0.0, 0.0}, 0.0), 0.0);
  EXPECT_LT(controller.command({-1.0, 0.0, 0.0}, 0.0), 0.0);
}

TEST_P(EveryController, SettlesWithTheBandwidthAskedForWhateverTheInertia) {
  auto options = of_kind(GetParam());
  options.bandwidth_hz = 5.0;
  // poles at -omega: the error has decayed by e^-omega t times a polynomial
  double const omega = 2.0 * std::numbers::pi * options.bandwidth_hz;
  for (double inertia : {0.0036, 0.09, 12.0}) {
    EXPECT_LT(std::abs(step_response(options, inertia, 20.0 / omega)), 1e-5) << inertia;
    EXPECT_GT(std::abs(step_response(options, inertia, 1.0 / omega)), 0.1) << inertia;
  }
}

TEST_P(EveryController, NeverExceedsItsTorqueLimit) {
  auto options = of_kind(GetParam());
  options.torque_limit = 0.7;
  Controller controller(options, rate_hz, 2.0, {});
  EXPECT_EQ(controller.command({5.0, 0.0, 0.0}, 0.0), 0.7);
  EXPECT_EQ(controller.command({-5.0, 0.0, 0.0}, 0.0), -0.7);
}

TEST_P(EveryController, AnswersAfterItsDelay) {
  auto options = of_kind(GetParam());
  options.delay_ticks = 2;
  Controller late(options, rate_hz, 0.1, {});
  options.delay_ticks = 0;
  Controller prompt(options, rate_hz, 0.1, {});
  double const first = prompt.command({1.0, 0.0, 0.0}, 0.1);
  EXPECT_EQ(late.command({1.0, 0.0, 0.0}, 0.1), 0.0);
  EXPECT_EQ(late.command({1.0, 0.0, 0.0}, 0.2), 0.0);
  EXPECT_EQ(late.command({1.0, 0.0, 0.0}, 0.3), first);
}

INSTANTIATE_TEST_SUITE_P(AllKinds, EveryController, testing::Values("p_velocity", "pd", "pid"),
                         [](auto const& tested) { return tested.param; });

TEST(Controller, CascadeIsThePrintedController) {
  auto options = of_kind("p_velocity");
  options.kp = 8.0;
  options.kv = 1.5;
  Controller controller(options, rate_hz, 0.1, {});
  controller.command({0.0, 0.0, 0.0}, 0.0);
  // e = 0.3, velocity = 0.002 / 0.001
  EXPECT_NEAR(controller.command({0.302, 9.0, 9.0}, 0.002), 1.5 * (8.0 * 0.3 - 2.0), 1e-12);
}

TEST(Controller, FeedforwardAddsTheTorqueOfTheInertia) {
  auto options = of_kind("pd");
  Controller plain(options, rate_hz, 0.25, {0.0, 2.0, 0.0});
  options.feedforward = true;
  Controller ahead(options, rate_hz, 0.25, {0.0, 2.0, 0.0});
  ReferencePoint const reference{0.1, 2.0, 4.0};
  EXPECT_DOUBLE_EQ(ahead.command(reference, 0.05) - plain.command(reference, 0.05), 0.25 * 4.0);
}

TEST(Controller, VelocityLowPassHasUnitGainForConstantSpeed) {
  auto options = of_kind("pd");
  options.kp = 1.0;
  options.kd = 3.0;
  options.velocity_cutoff_hz = 50.0;
  Controller controller(options, rate_hz, 0.1, {});
  double torque = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    double const q = 0.0007 * tick;
    torque = controller.command({q, 0.0, 0.0}, q);
  }
  EXPECT_NEAR(torque, -3.0 * 0.7, 1e-10);
}

TEST(Controller, IntegralDoesNotWindUpInTheLimit) {
  auto options = of_kind("pid");
  options.kp = 1.0;
  options.kd = 0.1;
  options.ki = 50.0;
  options.torque_limit = 1.0;
  Controller controller(options, rate_hz, 0.1, {});
  for (int tick = 0; tick < 5000; ++tick) controller.command({10.0, 0.0, 0.0}, 0.0);
  // back on the reference: what is left is at most what the limit allowed, not five seconds of error
  for (int tick = 0; tick < 30; ++tick) controller.command({-0.5, 0.0, 0.0}, 0.0);
  EXPECT_LT(controller.command({-0.5, 0.0, 0.0}, 0.0), 0.0);
}

TEST(ControllerRate, IsAMultipleOfTheRecordings) {
  EXPECT_EQ(controller_rate_hz({}, 200.0), 1000.0);
  EXPECT_EQ(controller_rate_hz({}, 300.0), 1200.0);
  EXPECT_EQ(controller_rate_hz({}, 4000.0), 4000.0);
}

TEST(ControllerCheck, RefusesWhatCannotWork) {
  Section const section{"simulate.controller", {}, {}};
  auto const count = [&](ControllerOptions const& options) {
    std::vector<Problem> problems;
    check_controller(options, 200.0, section, problems);
    return problems.size();
  };
  EXPECT_EQ(count({}), 0u);

  ControllerOptions options;
  options.rate_hz = 500.0;
  EXPECT_EQ(count(options), 1u);  // 2.5 ticks a sample
  options = {};
  options.kp = 3.0;
  EXPECT_EQ(count(options), 1u);  // kv is missing
  options.kv = 3.0;
  EXPECT_EQ(count(options), 0u);
  options.kd = 3.0;
  EXPECT_EQ(count(options), 1u);  // not a gain of p_velocity
  options = {};
  options.bandwidth_hz = 100.0;
  EXPECT_EQ(count(options), 1u);  // a tenth of a tick rate of 1000 Hz
  options = {};
  options.velocity_cutoff_hz = 500.0;
  EXPECT_EQ(count(options), 1u);
}

}  // namespace controller_test
