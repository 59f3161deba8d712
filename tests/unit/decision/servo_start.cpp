// Least squares on records of servos without a delay give back the numbers that the records were made of.

#include "engine/infer/decision/servo_start.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "engine/effects/regressor.hpp"

using namespace torquescope;

namespace servo_start_test {

constexpr double rate_hz = 100.0, gain = 0.25, kp = 1.5;
constexpr double inertia = 0.04, damping = 0.3, friction = 0.15, offset = 0.07;

// Differences over a twentieth of a second T see sin(w T) / (w T) of a speed and the square of sin(w T / 2) / (w T / 2)
// of an acceleration: within 1.5 % at the 1 Hz of these motions, which is what may be missing of inertia and damping.
// Friction has the sign of such a speed, wrong for a sample or two in each of some ten turns, and takes up what is
// missing of the damping: a hundredth of 0.3 N m s/rad at some rad/s is a twentieth of it
constexpr double of_derivatives = 0.015, of_the_rest = 0.01, of_friction = 0.05;

Regressor terms() { return {{"inertia", "viscous", "coulomb", "offset"}, JointKind::revolute}; }

LoopSetting loop() {
  LoopSetting made;
  made.form = LoopForm::p;
  made.values[LoopKey::kp] = kp;
  return made;
}

struct Weight {
  double by_sine = 0.0, by_cosine = 0.0;  // N m, of the joint's own
};

// in closed form: the motion is given, the goal is where the command that it takes comes from
RolloutTrack track(double mass, double command_gain, double pace, Weight const& own = {}) {
  constexpr Eigen::Index samples = 600;
  constexpr double length = 0.15, turn = 2.0 * std::numbers::pi;
  RolloutTrack made;
  made.rate_hz = rate_hz;
  made.known.gravity_moment = 9.80665 * mass * length;
  made.known.inertia = mass * length * length;
  made.known.command_gain = command_gain;
  made.position = made.reference = Eigen::VectorXd::Zero(samples);
  made.segments = {{0, samples, 0.0, 0.0, 0.0}};
  for (Eigen::Index k = 0; k < samples; ++k) {
    double const t = static_cast<double>(k) / rate_hz, slow = turn * 0.4 * pace, fast = turn * 0.9 * pace;
    double const q = 0.7 * std::sin(slow * t) + 0.25 * std::sin(fast * t + 0.6) + 0.4;
    double const dq = 0.7 * slow * std::cos(slow * t) + 0.25 * fast * std::cos(fast * t + 0.6);
    double const ddq = -0.7 * slow * slow * std::sin(slow * t) - 0.25 * fast * fast * std::sin(fast * t + 0.6);
    double const torque = (inertia + made.known.inertia) * ddq + damping * dq + std::copysign(friction, dq) + offset +
                          (made.known.gravity_moment + own.by_sine) * std::sin(q) + own.by_cosine * std::cos(q);
    made.position[k] = q;
    made.reference[k] = q + torque / gain / (kp * command_gain);
  }
  return made;
}

std::vector<RolloutTrack> records() { return {track(0.5, 20.0, 1.0), track(1.0, 60.0, 0.8), track(1.0, 20.0, 1.1)}; }

void expect_truth(ServoStart const& start) {
  ASSERT_TRUE(start.fixes_scale);
  ASSERT_EQ(start.terms.size(), 4);
  EXPECT_NEAR(start.motor_gain, gain, of_the_rest * gain);
  EXPECT_NEAR(start.damping, damping, of_derivatives * damping);
  // of the inertia all of the load's is known, so that a share of the whole is missing in the rest
  EXPECT_NEAR(start.terms[0], inertia, of_derivatives * (inertia + 0.0225));
  EXPECT_EQ(start.terms[1], 0.5 * start.damping);
  EXPECT_NEAR(start.terms[2], friction, of_friction * friction);
  EXPECT_NEAR(start.terms[3], offset, of_the_rest * 0.3);
}

TEST(ServoStart, GivesBackTheNumbersOfRecordsInClosedForm) { expect_truth(servo_start(terms(), loop(), records())); }

TEST(ServoStart, LeavesOutWhatMovedWithTheDriveOff) {
  auto tracks = records();
  for (auto& one : tracks) {
    one.enabled = Eigen::VectorXd::Ones(one.position.size());
    one.enabled.segment(200, 150).setZero();
    one.reference.segment(200, 150).setConstant(-3.0);
  }
  expect_truth(servo_start(terms(), loop(), tracks));
  for (auto& one : tracks) one.enabled.resize(0);
  EXPECT_GT(std::abs(servo_start(terms(), loop(), tracks).motor_gain - gain), 0.1 * gain);
}

// what a command beyond a limit asked for never acted
TEST(ServoStart, TakesTheCommandAsItsLimitLeavesIt) {
  auto tracks = records();
  for (auto& one : tracks) {
    // at most what the record took: only the goals that are moved away now are beyond it
    double const most = kp * one.known.command_gain * (one.reference - one.position).cwiseAbs().maxCoeff();
    one.known.command_limit = most;
    Eigen::Index furthest = 0;
    (one.reference - one.position).cwiseAbs().maxCoeff(&furthest);
    one.reference[furthest] += one.reference[furthest] > one.position[furthest] ? 1.0 : -1.0;
  }
  expect_truth(servo_start(terms(), loop(), tracks));
}

TEST(ServoStart, WithoutAKnownLoadIsInUnitsOfTheCommand) {
  ServoStart const start = servo_start(terms(), loop(), {track(0.0, 40.0, 0.9)});
  EXPECT_FALSE(start.fixes_scale);
  EXPECT_EQ(start.motor_gain, 1.0);
  EXPECT_NEAR(start.damping, damping / gain, of_derivatives * damping / gain);
  EXPECT_NEAR(start.terms[0], inertia / gain, of_derivatives * inertia / gain);
  EXPECT_NEAR(start.terms[2], friction / gain, of_friction * friction / gain);
}

// beside known loads, or where none is known: then in units of the command
TEST(ServoStart, FindsAWeightThatTheModelHas) {
  Regressor const with_weight{{"inertia", "viscous", "coulomb", "gravity"}, JointKind::revolute};
  Weight const own{0.4, -0.15};
  std::vector<RolloutTrack> tracks{track(0.5, 20.0, 1.0, own), track(1.0, 60.0, 0.8, own), track(0.0, 40.0, 1.1, own)};
  ServoStart const start = servo_start(with_weight, loop(), tracks);
  ASSERT_EQ(start.terms.size(), 5);
  // beside an offset, which a motion about one place hardly tells from the cosine of a weight
  EXPECT_NEAR(start.motor_gain, gain, of_the_rest * gain);
  EXPECT_NEAR(start.terms[0], inertia, of_derivatives * (inertia + 0.0225));
  EXPECT_NEAR(start.terms[3], own.by_sine, 0.05 * own.by_sine);
  EXPECT_NEAR(start.terms[4], own.by_cosine, 0.05 * own.by_sine);
  ServoStart const unknown = servo_start(with_weight, loop(), {track(0.0, 40.0, 1.0, own), track(0.0, 20.0, 0.7, own)});
  EXPECT_FALSE(unknown.fixes_scale);
  EXPECT_NEAR(unknown.terms[3], own.by_sine / gain, 0.05 * own.by_sine / gain);
  EXPECT_NEAR(unknown.terms[4], own.by_cosine / gain, 0.05 * own.by_sine / gain);
}

// a load whose inertia alone is known fixes it as well
TEST(ServoStart, ScalesByAnInertiaAlone) {
  auto tracks = records();
  for (auto& one : tracks) one.known.gravity_moment = 0.0;
  EXPECT_TRUE(servo_start(terms(), loop(), tracks).fixes_scale);
}

TEST(ServoStart, IsAJointWhateverTheRecordsSay) {
  auto tracks = records();
  for (auto& one : tracks) one.reference = 2.0 * one.position - one.reference;  // a drive that pushes away
  ServoStart const start = servo_start(terms(), loop(), tracks);
  EXPECT_TRUE(start.terms.allFinite());
  EXPECT_GT(start.terms[0], 0.0);
  EXPECT_GT(start.terms[2], 0.0);
  EXPECT_GE(start.motor_gain, 0.0);
  EXPECT_GE(start.damping, 0.0);
  // too few rows for least squares
  tracks.resize(1);
  tracks[0].segments[0].samples = 14;
  EXPECT_TRUE(servo_start(terms(), loop(), tracks).terms.isZero());
}

}  // namespace servo_start_test
