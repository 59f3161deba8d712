// Every controller of drive and gear does in the lanes what it does in a servo that is simulated by itself in twenty
// times finer steps: each alone, all together, and with what a track knows of its load.

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "engine/simulate/rollout/loop_lanes.hpp"
#include "unit/rollout/servos.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace servo_lanes_test {

// A tick h of a millisecond is a step of second order: it leaves h^2 / 6 of what the acceleration changes by, of a
// hundred rad/s2 2e-5 rad, which a loop forgets and a joint whose drive is off does not. Steps of h / 20 leave
// a four hundredth. What is late by a tick is off by h times three rad/s, fifty times as much
constexpr double near = 6e-5, velocity_for_position = 200.0;  // 1/s
constexpr double moves = 1e-3;                                // rad, that a controller must do to be tested by this
constexpr int samples = 300, ticks_per_sample = 10;
constexpr double rate_hz = 100.0;
constexpr PlainStart start{0.1, 0.0, 0.0};

struct Case {
  std::string name;
  std::function<void(PlainServo&)> change;
  double jump = 0.0;  // V, of the command at an error that it turns or begins at
};

std::vector<Case> const controllers{{"load friction", [](PlainServo& s) { s.load = 0.2; }},
                                    {"friction by the square of the load", [](PlainServo& s) { s.load_square = 0.1; }},
                                    {"Stribeck friction", [](PlainServo& s) { s.stribeck = 0.15; }},
                                    {"Stribeck friction of the load", [](PlainServo& s) { s.load_stribeck = 0.25; }},
                                    {"friction over the angle",
                                     [](PlainServo& s) {
                                       s.angle_cos = 0.04;
                                       s.angle_sin = -0.06;
                                     }},
                                    {"dead band", [](PlainServo& s) { s.dead_band = 0.03; }, 1.8},
                                    {"punch", [](PlainServo& s) { s.punch = 1.5; }, 3.0},
                                    {"limit", [](PlainServo& s) { s.limit = 6.0; }},
                                    {"motor gain", [](PlainServo& s) { s.motor_gain = 0.32; }},
                                    {"back-EMF", [](PlainServo& s) { s.back_emf = 0.4; }},
                                    {"delay of whole ticks", [](PlainServo& s) { s.command_delay_s = 0.037; }},
                                    {"delay between ticks", [](PlainServo& s) { s.command_delay_s = 0.0234; }},
                                    {"offset", [](PlainServo& s) { s.offset = 0.2; }},
                                    {"all",
                                     [](PlainServo& s) {
                                       s.load = 0.1;
                                       s.load_square = 0.03;
                                       s.stribeck = 0.1;
                                       s.load_stribeck = 0.1;
                                       s.dead_band = 0.03;
                                       s.punch = 0.6;
                                       s.limit = 9.0;
                                       s.motor_gain = 0.3;
                                       s.back_emf = 0.25;
                                       s.command_delay_s = 0.0307;
                                       s.offset = 0.05;
                                     },
                                     1.8}};

PlainServo loaded() {
  PlainServo servo;
  servo.weight = 1.2;
  return servo;
}

PlainInputs inputs(bool is_straight, bool has_pauses) {
  PlainInputs made;
  made.rate_hz = rate_hz;
  made.ticks_per_sample = ticks_per_sample;
  made.straight = is_straight;
  made.reference = servo_goals(samples, rate_hz);
  for (int k = 0; has_pauses && k < samples; ++k) made.enabled.push_back(k % 120 < 95 ? 1.0 : 0.0);
  return made;
}

// A command that jumps may jump a tick apart, where errors are alike but on two sides of the threshold: an impulse,
// which the loop turns into a way at its own frequency
double tolerance_of(Case const& controller, PlainServo const& servo) {
  double const tick_s = 1.0 / (rate_hz * ticks_per_sample);
  double const swing = std::sqrt(servo.gain * servo.motor_gain / servo.inertia);  // rad/s
  return near + controller.jump * servo.motor_gain * tick_s / servo.inertia / swing;
}

double largest(Eigen::VectorXd const& a, Eigen::VectorXd const& b) { return (a - b).cwiseAbs().maxCoeff(); }

// in a lane beside another servo
Rolled rolled_beside(RolloutTrack const& track, RolloutTrial const& trial, RolloutStructure const& structure = {}) {
  RolloutTrial other = trial;
  other.joint.inertia *= 1.3;
  other.loop.command_delay_s += 0.01;
  return rolled(track, structure, {other, trial});
}

TEST(ServoLanes, DoWhatTheServoDoesByItself) {
  for (bool const is_straight : {false, true})
    for (bool const has_pauses : {false, true}) {
      PlainInputs const in = inputs(is_straight, has_pauses);
      Eigen::VectorXd const without = vector_of(run_servo(loaded(), in, start).position);
      for (auto const& controller : controllers) {
        PlainServo servo = loaded();
        controller.change(servo);
        ServoMotion const plain = run_servo(servo, in, start);
        Rolled const all = rolled_beside(track_of(in, start), trial_of(servo));
        double const tolerance = tolerance_of(controller, servo);
        EXPECT_LT(largest(all.position.col(1), vector_of(plain.position)), tolerance) << controller.name;
        EXPECT_LT(largest(all.velocity.col(1), vector_of(plain.velocity)), velocity_for_position * tolerance)
            << controller.name;
        if (controller.jump == 0.0) {
          EXPECT_LT(largest(all.torque.col(1), vector_of(plain.command)), 2.0 * servo.gain * tolerance)
              << controller.name;
        }
        EXPECT_GT(largest(without, vector_of(plain.position)), moves) << controller.name;
      }
    }
}

// what a track knows stands beside the trial: a load, a bar of an unknown mass, a gain and a limit of its drive, heat
TEST(ServoLanes, CarryWhatATrackKnows) {
  PlainInputs const in = inputs(false, true);
  constexpr double gravity = 9.80665, mass = 0.6, length = 0.16, arm_mass = 0.08, per_kelvin = -0.004;
  PlainServo const bare;
  RolloutTrial trial = trial_of(bare);
  trial.arm_mass = arm_mass;
  trial.motor_gain_per_kelvin = per_kelvin;
  trial.loop.kp = 2.0;
  trial.loop.most = 11.0;
  trial.loop.least = -11.0;
  PlainServo carries = bare;
  carries.gain = 2.0 * 31.0;
  carries.limit = 7.0;
  carries.motor_gain *= 1.0 + per_kelvin * (41.0 - 25.0);
  carries.inertia += mass * length * length + arm_mass * length * length / 3.0;
  carries.weight += gravity * (mass + 0.5 * arm_mass) * length;
  RolloutTrack track = track_of(in, start);
  track.known = {gravity * mass * length, mass * length * length, 31.0, 7.0, length, 41.0};
  ServoMotion const plain = run_servo(carries, in, start);
  Rolled const all = rolled_beside(track, trial);
  EXPECT_LT(largest(all.position.col(1), vector_of(plain.position)), near);
  EXPECT_EQ(all.torque.col(1).cwiseAbs().maxCoeff(), 7.0);
  // each of it does something
  for (int one = 0; one < 6; ++one) {
    RolloutTrack lacks = track;
    TrackKnown const none{0.0, 0.0, 25.0, 9.0, 0.0, std::nan("")};
    double TrackKnown::*const numbers[] = {&TrackKnown::gravity_moment, &TrackKnown::inertia,
                                           &TrackKnown::command_gain,   &TrackKnown::command_limit,
                                           &TrackKnown::arm_length,     &TrackKnown::temperature};
    lacks.known.*numbers[one] = none.*numbers[one];
    Rolled const other = rolled_beside(lacks, trial);
    EXPECT_GT(largest(other.position.col(1), vector_of(plain.position)), moves) << one;
  }
  // the trial's own limit where it is the lower one
  track.known.command_limit = 13.0;
  EXPECT_EQ(rolled_beside(track, trial).torque.col(1).cwiseAbs().maxCoeff(), 11.0);
}

// friction of the gear is held from tick to tick: of first order, so that half a tick leaves half of the difference
// from a gear that rubs as it moves. The drive answers every two milliseconds in all of them
TEST(ServoLanes, ComeToAGearThatRubsWithoutTicks) {
  PlainServo servo = loaded();
  servo.load = 0.2;
  servo.stribeck = 0.1;
  servo.load_stribeck = 0.1;
  PlainServo smooth = servo;
  smooth.rubs_every_step = true;
  std::vector<double> off;
  for (int const ticks : {1, 2, 4}) {
    PlainInputs in = inputs(false, false);
    in.ticks_per_sample = 5 * ticks;
    smooth.hold = ticks;
    RolloutStructure structure;
    structure.hold_ticks = static_cast<std::size_t>(ticks);
    ServoMotion const plain = run_servo(smooth, in, start, 160 / ticks);
    Rolled const all = rolled_beside(track_of(in, start), trial_of(servo), structure);
    off.push_back(std::sqrt((all.position.col(1) - vector_of(plain.position)).squaredNorm() / samples));
  }
  EXPECT_LT(off[1], 0.65 * off[0]);
  EXPECT_LT(off[2], 0.65 * off[1]);
  EXPECT_LT(off[0], moves);
}

// the bell of a Stribeck friction is that of the header, and within 0.03 of the exponential one
TEST(ServoLanes, FallFromStickingToSlidingByTheBell) {
  LaneGears gears;
  alignas(64) double motor[replicate_lanes], weight[replicate_lanes], speed[replicate_lanes], friction[replicate_lanes];
  alignas(64) double sine[replicate_lanes], cosine[replicate_lanes];
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    gears.set(lane, {0.1, 0.05, 0.3, 0.2, 0.4, 0.5, 0.07, -0.02});
    motor[lane] = 0.3 * static_cast<double>(lane) - 2.0;
    weight[lane] = 1.1 - 0.1 * static_cast<double>(lane);
    speed[lane] = 0.09 * (static_cast<double>(lane) - 6.0);
    sine[lane] = std::sin(0.4 * static_cast<double>(lane));
    cosine[lane] = std::cos(0.4 * static_cast<double>(lane));
  }
  ASSERT_TRUE(gears.any);
  gear_friction(gears, motor, weight, speed, sine, cosine, friction);
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    double const l = 0.5 * std::abs(motor[lane] + weight[lane]), x = speed[lane] / 0.4;
    double const bell = std::pow(1.0 + x * x / 16.0, -16.0);
    double const of_angle = 0.07 * cosine[lane] - 0.02 * sine[lane];
    EXPECT_NEAR(friction[lane], 0.1 * l + 0.05 * l * l + (0.3 + 0.2 * l) * bell + of_angle, 1e-14);
    EXPECT_NEAR(bell, std::exp(-x * x), 0.03);
  }
}

}  // namespace servo_lanes_test
