// The controller of a recording, by regression.

#include "engine/simulate/controller_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/simulate/joint_simulation.hpp"
#include "unit/simulate/plants.hpp"

using namespace torquescope;
using torquescope::test::plant;

namespace controller_fit_test {

constexpr double torque_noise = 0.02;

SimulationPlan loop_plan(std::string const& kind) {
  SimulationPlan plan;
  plan.simulation.rate_hz = 1000.0;
  plan.simulation.duration_s = 15.0;
  plan.simulation.step_s = 1e-4;
  plan.plant = plant({{"inertia", 0.036}, {"viscous", 0.164}, {"coulomb", 1.3}, {"offset", -0.125}});
  plan.controller.kind = kind;
  plan.controller.bandwidth_hz = 8.0;
  plan.controller.velocity_cutoff_hz = 0.0;
  plan.encoder.counts_per_revolution = 400000;
  plan.noise.torque_std = torque_noise;
  return plan;
}

ControllerFit fit(SimulatedRecording const& recording) {
  return fit_controller({recording.time_s, recording.reference, recording.position, recording.torque});
}

// what a loop's gains amount to: torque per error and torque per velocity
double stiffness(ControllerGains const& g) { return g.kv > 0.0 ? g.kp * g.kv : g.kp; }
double damping(ControllerGains const& g) { return g.kv > 0.0 ? g.kv : g.kd; }

// every second, third ... sample, as a slow logger writes
SimulatedRecording thinned(SimulatedRecording const& whole, Eigen::Index factor) {
  SimulatedRecording few = whole;
  Eigen::Index const n = whole.position.size() / factor;
  for (auto channel : {&SimulatedRecording::time_s, &SimulatedRecording::reference, &SimulatedRecording::position,
                       &SimulatedRecording::torque})
    few.*channel = Eigen::VectorXd((whole.*channel)(Eigen::seqN(0, n, factor)));
  return few;
}

class EveryIdentifiedController : public testing::TestWithParam<std::string> {};

TEST_P(EveryIdentifiedController, IsIdentifiedWithTheTorqueNoiseAsItsRemainder) {
  auto const recording = simulate_joint(loop_plan(GetParam()), 3);
  auto const found = fit(recording);
  EXPECT_TRUE(found.is_white) << found.remark;
  EXPECT_EQ(found.controller.shift, 0);
  EXPECT_TRUE(found.limited.empty());
  EXPECT_GT(found.r_squared, 0.999);
  // noise / (gain * sqrt(n) * spread of the regressor): 0.1 % and 0.2 % are more than five standard errors
  EXPECT_NEAR(found.controller.proportional_gain() / stiffness(recording.gains), 1.0, 1e-3);
  EXPECT_NEAR(found.controller.velocity_gain(1000.0) / damping(recording.gains), 1.0, 4e-3);
  EXPECT_NEAR(found.noise.std / torque_noise, 1.0, 4.0 / std::sqrt(2.0 * 15000.0));
  if (GetParam() == "pid")
    EXPECT_NEAR(found.controller.integral * 1000.0 / recording.gains.ki, 1.0, 3e-3);
  else
    EXPECT_EQ(found.controller.integral, 0.0);
}

TEST_P(EveryIdentifiedController, IsIdentifiedBehindAVelocityFilter) {
  auto plan = loop_plan(GetParam());
  plan.controller.velocity_cutoff_hz = 100.0;
  plan.noise.torque_std = 0.002;
  auto const found = fit(simulate_joint(plan, 3));
  EXPECT_TRUE(found.is_white) << found.remark;
  EXPECT_GT(found.lags, 3);
}

TEST_P(EveryIdentifiedController, GivesWayAtItsTorqueLimit) {
  auto plan = loop_plan(GetParam());
  plan.controller.torque_limit = 1.5;
  // no integral: what stops it at the limit is not in any recording
  if (GetParam() == "pid") return;
  auto const recording = simulate_joint(plan, 4);
  ASSERT_GT(recording.saturated_samples, 100);
  auto const found = fit(recording);
  EXPECT_TRUE(found.is_white) << found.remark;
  auto const limited = static_cast<double>(found.limited.size()),
             saturated = static_cast<double>(recording.saturated_samples);
  EXPECT_NEAR(limited, saturated, 0.05 * saturated);
  EXPECT_NEAR(found.controller.most, 1.5, 0.01);
  EXPECT_NEAR(found.controller.least, -1.5, 0.01);
  EXPECT_NEAR(found.controller.proportional_gain() / stiffness(recording.gains), 1.0, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryIdentifiedController, testing::Values("pd", "pid", "p_velocity"));

TEST(ControllerFit, FindsAReferenceThatIsLoggedLate) {
  // a reference with corners: a smooth one is as well extrapolated from its neighbouring samples
  auto plan = loop_plan("pd");
  plan.reference.kind = "trapezoid";
  plan.reference.speeds = {1.0, 3.0};
  plan.noise.torque_std = 0.002;
  auto recording = simulate_joint(plan, 3);
  Eigen::VectorXd const reference = recording.reference;
  for (Eigen::Index k = 0; k < reference.size(); ++k)
    recording.reference[k] = reference[std::max<Eigen::Index>(k - 2, 0)];
  auto const found = fit(recording);
  EXPECT_TRUE(found.is_white) << found.remark;
  EXPECT_EQ(found.controller.shift, 2);
}

TEST(ControllerFit, TellsASensorDriftFromTheLoop) {
  auto recording = simulate_joint(loop_plan("pid"), 3);
  double const drift = 0.005;
  recording.torque += drift * recording.time_s;
  auto const found = fit(recording);
  EXPECT_TRUE(found.is_white) << found.remark;
  EXPECT_NEAR(found.drift_per_s / drift, 1.0, 0.05);
  EXPECT_GT(found.drift_z, 10.0);
  EXPECT_NEAR(found.noise.std / torque_noise, 1.0, 4.0 / std::sqrt(2.0 * 15000.0));
}

// The torque of a pd loop behind a feedforward that its author wrote otherwise than the search does: a slope over three
// samples, friction as an arctangent, gravity of the reference's angle
TEST(ControllerFit, FindsFrictionAndGravityFedForward) {
  auto recording = simulate_joint(loop_plan("pd"), 3);
  auto const& r = recording.reference;
  double const friction = 1.1, gravity = 0.7, knee = 0.03;
  for (Eigen::Index k = 0; k < r.size(); ++k) {
    Eigen::Index const back = std::max<Eigen::Index>(k - 3, 0);
    double const velocity = (r[k] - r[back]) / 3.0 * recording.rate_hz;
    recording.torque[k] += friction * std::atan(velocity / knee) / std::atan(1e9) + gravity * std::sin(r[k]);
  }
  auto const found = fit(recording);
  EXPECT_NEAR(found.noise.std / torque_noise, 1.0, 0.1);
  EXPECT_NEAR(found.controller.proportional_gain() / stiffness(recording.gains), 1.0, 3e-3);
  // at a steady speed all of the friction is there, with its sign
  double forward = 0.0, gravity_found = 0.0;
  Eigen::VectorXd ramp = Eigen::VectorXd::LinSpaced(100, 0.0, 0.2);
  for (auto const& term : found.controller.terms) {
    if (term.shape == ReferenceShape::smooth_sign) forward += term.gain * term(ReferenceSignal(ramp), 50);
    if (term.shape == ReferenceShape::sine) gravity_found = term.gain;
  }
  EXPECT_NEAR(forward, friction, 0.05);
  EXPECT_NEAR(gravity_found, gravity, 0.02);
}

// a joint of an arm: the controller gives what the other joints need, by their references, behind which they lag
TEST(ControllerFit, FindsTheLoadOfOtherJointsFedForward) {
  auto recording = simulate_joint(loop_plan("pd"), 3);
  Eigen::Index const n = recording.torque.size(), ahead = 3;
  auto const load_at = [](Eigen::Index k) {
    double const t = 1e-3 * static_cast<double>(k);
    return 8.0 * std::sin(2.1 * t) + 3.0 * std::cos(5.3 * t + 1.0);
  };
  Eigen::VectorXd load(n), whole(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    load[k] = load_at(k);
    whole[k] = recording.torque[k] + 0.9 * load_at(k + ahead);
  }
  auto const found = fit_controller({recording.time_s, recording.reference, recording.position, whole, &load});
  EXPECT_TRUE(found.is_white) << found.remark;
  EXPECT_NEAR(found.noise.std / torque_noise, 1.0, 4.0 / std::sqrt(2.0 * 15000.0));
  EXPECT_NEAR(found.controller.proportional_gain() / stiffness(recording.gains), 1.0, 2e-3);
  EXPECT_NEAR(found.controller.gear_load[0], 0.9, 2e-3);
  EXPECT_NEAR(found.controller.gear_load[1] / (0.9 * static_cast<double>(ahead)), 1.0, 0.05);
  // not told of the load, it cannot but take it for noise
  EXPECT_GT(fit_controller({recording.time_s, recording.reference, recording.position, whole}).noise.std,
            2.0 * torque_noise);
}

TEST(ControllerFit, FeedsNothingForwardThatIsNotThere) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_TRUE(fit(simulate_joint(loop_plan("pd"), seed)).controller.terms.empty());
  // nor where the noise has a memory
  auto recording = simulate_joint(loop_plan("pd"), 3);
  double memory = 0.0;
  for (Eigen::Index k = 0; k < recording.torque.size(); ++k)
    recording.torque[k] += memory =
        0.9 * memory + (recording.torque[k] - recording.torque[std::max<Eigen::Index>(k - 1, 0)]) * 0.3;
  EXPECT_TRUE(fit(recording).controller.terms.empty());
}

TEST(ControllerFit, SaysWhenTheLoggerWasTooSlow) {
  auto plan = loop_plan("pd");
  plan.noise.torque_std = 0.002;
  auto const whole = simulate_joint(plan, 3);
  // ten times too slow leaves too few samples to tell a correlation of 0.04 from chance
  for (Eigen::Index factor : {2, 5}) {
    auto const found = fit(thinned(whole, factor));
    EXPECT_FALSE(found.is_white) << factor;
    EXPECT_GT(found.noise.std, 1.2 * plan.noise.torque_std) << factor;
    EXPECT_FALSE(found.noise.past.empty()) << factor;
  }
}

TEST(ControllerFit, RarelyDoubtsATrueController) {
  // 1 % by construction: 4 of 40 would be a chance of 7e-4
  int doubts = 0;
  auto plan = loop_plan("pd");
  plan.simulation.duration_s = 4.0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) doubts += !fit(simulate_joint(plan, seed)).is_white;
  EXPECT_LT(doubts, 4);
}

// a reference with a single kink (0.5 s) leaves the controller of the first look undetermined in a few rows; their
// errors must not pass for a torque limit
TEST(ControllerFit, FindsNoLimitBelowTheTorqueThatWasReached) {
  auto plan = loop_plan("pd");
  plan.simulation.duration_s = 8.0;
  plan.reference.amplitude = 1.5;
  plan.plant = plant({{"inertia", 0.036},
                      {"viscous", 0.164},
                      {"coulomb", 1.3},
                      {"offset", -0.125},
                      {"stribeck", 0.5},
                      {"stribeck_speed", 0.3},
                      {"stribeck_exponent", 1.0}});
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    auto const recording = simulate_joint(plan, seed);
    auto const found = fit(recording);
    EXPECT_TRUE(found.limited.empty()) << seed;
    EXPECT_GT(found.controller.most, recording.torque.maxCoeff() - 6.0 * torque_noise) << seed;
    EXPECT_LT(found.controller.least, recording.torque.minCoeff() + 6.0 * torque_noise) << seed;
  }
}

}  // namespace controller_fit_test
