// The servo's plant beside closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "servo/drive.hpp"
#include "servo/joint.hpp"
#include "servo/laws.hpp"
#include "servo/recording.hpp"

namespace servo {
namespace servo_laws_test {

constexpr double tick_s = steps_per_tick * step_s;
constexpr double count = 2.0 * std::numbers::pi / encoder_counts;
constexpr Setting no_load{0.0, 0.15};
constexpr Setting one_kilogram{1.0, 0.15};

ServoNumbers without_friction() {
  ServoNumbers servo;
  servo.coulomb = servo.viscous = 0.0;
  return servo;
}

// The position after some seconds of one voltage
double after(Joint& joint, double seconds, double command_v, bool is_on) {
  for (long step = std::lround(seconds / step_s); step > 0; --step) joint.step(command_v, is_on);
  return joint.position();
}

TEST(ServoJoint, RestsBelowItsDryFrictionAndMovesAboveIt) {
  ServoNumbers const servo;
  double const least_v = servo.coulomb / servo.motor_gain;
  Joint rests{servo, no_load}, moves{servo, no_load};
  EXPECT_EQ(after(rests, 1.0, 0.99 * least_v, true), 0.0);
  EXPECT_GT(after(moves, 1.0, 1.01 * least_v, true), 1e-4);
}

TEST(ServoJoint, FrictionOfTheLoadHoldsAWeightUpToAnAngle) {
  // drive off: l = G sin q / 2, so G sin q = coulomb + load_friction l where it begins to slide
  ServoNumbers servo;
  servo.load_friction = 0.4;
  Joint joint{servo, one_kilogram};
  double const angle = std::asin(servo.coulomb / (1.0 - 0.5 * servo.load_friction) / joint.gravity_moment());
  joint.put(0.99 * angle, 0.0);
  EXPECT_EQ(after(joint, 1.0, 0.0, false), 0.99 * angle);
  joint.put(1.01 * angle, 0.0);
  EXPECT_LT(after(joint, 1.0, 0.0, false), angle);
}

TEST(ServoJoint, StribeckFrictionIsWholeAtRest) {
  ServoNumbers servo;
  servo.stribeck_friction = 0.1;
  Joint joint{servo, no_load};
  double const least_v = (servo.coulomb + servo.stribeck_friction) / servo.motor_gain;
  EXPECT_EQ(after(joint, 1.0, 0.99 * least_v, true), 0.0);
  // once it slides fast, the rise is gone: it goes on under less than what it held
  joint.put(0.0, 4.0 * servo.stribeck_speed);
  after(joint, 2.0, 0.95 * least_v, true);
  double const steady = (0.95 * least_v * servo.motor_gain - servo.coulomb) / (servo.viscous + servo.back_emf);
  EXPECT_NEAR(joint.speed(), steady, 0.05 * steady);
}

TEST(ServoJoint, SmallSwingWithoutFrictionHasThePendulumsPeriod) {
  ServoNumbers servo = without_friction();
  servo.arm_mass = 0.1;
  Joint joint{servo, one_kilogram};
  double const length = one_kilogram.length_m, size = 0.05;
  double const inertia = servo.inertia + (1.0 + 0.1 / 3.0) * length * length;
  double const moment = gravity_m_s2 * length * 1.05;
  double const period =
      2.0 * std::numbers::pi * std::sqrt(inertia / moment) * (1.0 + size * size / 16.0);  // second term of the series
  joint.put(size, 0.0);
  EXPECT_NEAR(after(joint, 10.0 * period, 0.0, false), size, 1e-4) << "ten swings later";
  EXPECT_NEAR(after(joint, 0.5 * period, 0.0, false), -size, 1e-4);
}

TEST(ServoJoint, RunsFreeWhereBackEmfAndFrictionTakeAllTorque) {
  ServoNumbers const servo;
  Joint joint{servo, no_load};
  after(joint, 3.0, 10.0, true);
  double const steady = (10.0 * servo.motor_gain - servo.coulomb) / (servo.viscous + servo.back_emf);
  EXPECT_NEAR(joint.speed(), steady, 1e-3 * steady);
}

TEST(ServoJoint, SlowsOnlyByItsFrictionWhileTheDriveIsOff) {
  ServoNumbers servo = without_friction();
  servo.viscous = 0.05;
  Joint joint{servo, no_load};
  joint.put(0.0, 2.0);
  after(joint, 0.5, 10.0, false);
  EXPECT_NEAR(joint.speed(), 2.0 * std::exp(-0.5 * servo.viscous / joint.inertia()), 1e-3) << "no back-EMF";
}

TEST(LedGoal, NeverPassesItsLimitsAndArrivesInTheTimeOfATrapezoid) {
  double const speed_limit = 4.0, acceleration_limit = 30.0, way = 1.5;
  LedGoal led{speed_limit, acceleration_limit, 0.0};
  double before = 0.0, speed_before = 0.0, arrived_s = 0.0;
  for (int tick = 1; tick <= 1000; ++tick) {
    double const goal = led.tick(way), speed = (goal - before) / tick_s;
    EXPECT_LE(std::abs(speed), speed_limit * (1.0 + 1e-9));
    EXPECT_LE(std::abs(speed - speed_before) / tick_s, acceleration_limit * (1.0 + 1e-6));
    EXPECT_LE(goal, way) << "it does not pass the goal";
    if (arrived_s == 0.0 && goal == way) arrived_s = tick * tick_s;
    before = goal, speed_before = speed;
  }
  EXPECT_NEAR(arrived_s, way / speed_limit + speed_limit / acceleration_limit, 3.0 * tick_s);
}

TEST(LedGoal, FollowsAtOnceWithoutLimits) {
  LedGoal led{no_limit, no_limit, 0.0};
  EXPECT_EQ(led.tick(1.5), 1.5);
  EXPECT_EQ(led.tick(-0.3), -0.3);
}

TEST(ServoDrive, CommandHasADeadBandALeastAndALimit) {
  ServoNumbers servo;
  servo.dead_band = 0.01;
  servo.punch = 2.0;
  auto command = [&](double error) {
    Drive drive{servo, no_load, 0.0};
    drive.tick(0.0, -error);
    return drive.step(true);
  };
  double const gain = no_load.command_gain();
  EXPECT_EQ(command(0.0), 0.0);
  EXPECT_EQ(command(0.0099), 0.0);
  EXPECT_EQ(command(0.011), 2.0);
  EXPECT_EQ(command(-0.011), -2.0);
  EXPECT_DOUBLE_EQ(command(0.1), 0.1 * gain);
  EXPECT_EQ(command(-3.0), -no_load.command_limit());
}

TEST(ServoDrive, CommandComesThroughItsLag) {
  ServoNumbers servo;
  servo.torque_lag_s = 0.005;
  Drive drive{servo, no_load, 0.0};
  drive.tick(0.1, 0.0);
  double given = 0.0;
  for (int step = 0; step < 50; ++step) given = drive.step(true);
  EXPECT_NEAR(given, 0.1 * no_load.command_gain() * (1.0 - std::exp(-1.0)), 1e-9);
  EXPECT_EQ(drive.step(false), 0.0);
}

std::vector<Sample> step_of(double goal, double at_s, double duration_s) {
  std::vector<Sample> samples;
  for (int k = 0; k * log_period_s < duration_s; ++k)
    samples.push_back({k * log_period_s, k * log_period_s < at_s ? 0.0 : goal, true});
  return samples;
}

TEST(ServoRecording, HoldsAWeightWithTheErrorThatItsGainNeeds) {
  ServoNumbers servo;
  servo.coulomb = 0.002;
  for (double kp : {8.0, 32.0}) {
    Setting const setting{1.0, 0.15, kp};
    double const q = record(servo, setting, step_of(1.0, 0.0, 4.0)).position.back();
    double const stiffness = servo.motor_gain * setting.command_gain();
    double const balance = stiffness * (1.0 - q) - Joint{servo, setting}.gravity_moment() * std::sin(q);
    EXPECT_LT(std::abs(balance), servo.coulomb + 0.5 * stiffness * count) << "kp " << kp;
  }
}

TEST(ServoRecording, DelayMovesTheAnswerByItself) {
  ServoNumbers servo;
  auto const samples = step_of(1.0, 0.5, 2.0);
  Recording const at_once = record(servo, one_kilogram, samples);
  servo.command_delay_s = 0.03;
  Recording const late = record(servo, one_kilogram, samples);
  for (std::size_t k = 3; k < samples.size(); ++k) EXPECT_EQ(late.position[k], at_once.position[k - 3]) << k;
}

TEST(ServoRecording, FallsWhenTheDriveIsOffAndComesToRest) {
  auto const samples = draw_motion({}, static_cast<int>(Kind::lift_and_drop), 0);
  ServoNumbers const servo;
  Recording const made = record(servo, one_kilogram, samples);
  double const highest = std::abs(*std::max_element(made.position.begin(), made.position.end(),
                                                    [](double a, double b) { return std::abs(a) < std::abs(b); }));
  EXPECT_GT(highest, 1.2);
  EXPECT_FALSE(samples.back().is_on);
  double const rests_within = std::asin(servo.coulomb / Joint{servo, one_kilogram}.gravity_moment());
  EXPECT_LE(std::abs(made.position.back()), rests_within);
  EXPECT_EQ(made.position.back(), made.position[made.position.size() - 20]);
}

TEST(ServoLaws, EveryLawIsDrawnInItsRangeAndChangesNoOtherNumber) {
  Setting const light{0.5, 0.1};
  ServoNumbers const base = draw_servo(3, {}, light);
  for (Law const& law : laws) {
    ServoNumbers const servo = draw_servo(3, {law.name}, light);
    EXPECT_EQ(base.*law.number, law.without) << law.name;
    EXPECT_GE(servo.*law.number, law.low) << law.name;
    EXPECT_LE(servo.*law.number, law.high) << law.name;
    EXPECT_EQ(servo.inertia, base.inertia) << law.name;
  }
  EXPECT_THROW(draw_servo(3, {"stribek"}, light), std::invalid_argument);
}

TEST(ServoLaws, DrawnServosLiftTheHeaviestLoad) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    ServoNumbers const servo = draw_servo(seed, {"load_friction", "load_square", "load_stribeck"}, one_kilogram);
    Joint joint{servo, one_kilogram};
    joint.put(1.5, 0.0);
    EXPECT_GT(after(joint, 0.5, one_kilogram.command_limit(), true), 1.5) << seed;
  }
}

}  // namespace servo_laws_test
}  // namespace servo
