// Effects of the catalogue in the lanes act where they say: a sensor's fault shifts its own channel and nothing else.

#include "engine/simulate/lane_effect.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/simulate/replicate_simulator.hpp"
#include "engine/simulate/tracking_controller.hpp"

using namespace torquescope;

namespace lane_effect_test {

constexpr double rate_hz = 1000.0;
constexpr Eigen::Index samples = 2000;
constexpr double rounding = 1e-12;

// a motor that plays its reference as torque and looks at nothing: whatever a sensor shows, the joint moves alike
ReplicateLoop blind_loop() {
  ReplicateLoop loop;
  loop.controller.position = {0.0};
  loop.controller.reference = {0.0, 1.0, 0.0};
  loop.torque_noise = white(0.02);
  loop.position_noise_std = 1e-4;
  return loop;
}

// stiff, with the position fed back
ReplicateLoop closed_loop() {
  ReplicateLoop loop = blind_loop();
  loop.controller = tracking_controller({0.04}, 10.0, {rate_hz});
  return loop;
}

ReplicateTrack track(double size) {
  ReplicateTrack made;
  made.rate_hz = rate_hz;
  made.reference.resize(samples);
  for (Eigen::Index k = 0; k < samples; ++k) made.reference[k] = size * std::sin(0.006 * static_cast<double>(k));
  return made;
}

ReplicateGroup simulated(ReplicateLoop const& loop, ReplicateTrack const& reference,
                         std::vector<LaneEffectMaker> effects) {
  ReplicateJoint joint;
  joint.lanes = {0.04, 0.2, 0.0, 0.0};
  joint.coulomb_forward = 0.3;
  joint.coulomb_backward = -0.3;
  joint.effects = std::move(effects);
  ReplicateGroup group;
  ReplicateSimulator(joint, loop, reference, 1e-4).simulate({5, 0, 0}, 0, group);
  return group;
}

// slope, step and the time of the step
constexpr double drift = 0.07, jump = -0.4, jump_s = 0.85;
LaneEffectMaker sensor_drift() { return lane_effect(*find_effect("sensor_drift"), {drift, jump, jump_s}, {}); }

constexpr double sine = 0.004, cosine = -0.003;
LaneEffectMaker eccentricity() {
  return lane_effect(*find_effect("encoder_eccentricity"), {sine, cosine, 0.0, 0.0}, {});
}

Eigen::VectorXd reading_error(Eigen::VectorXd const& q) {
  return (sine * q.array().sin() + cosine * q.array().cos()).matrix();
}

// what a fresh effect adds, and where
struct Answer {
  LaneDemand demand{};
  double position[replicate_lanes] = {}, torque[replicate_lanes] = {};
};

Answer answer(LaneEffectMaker const& make, LaneInstant const& at) {
  auto const effect = make();
  Answer given;
  effect->add(at, given.demand);
  effect->shift_position(at, given.position);
  effect->shift_torque(at, given.torque);
  return given;
}

LaneInstant some_instant() {
  LaneInstant at;
  at.time_s = 0.9;
  at.step_s = 1e-3;
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    at.q[lane] = 0.3 * static_cast<double>(lane);
    at.dq[lane] = 1.0 - 0.2 * static_cast<double>(lane);
    at.motor_torque[lane] = 0.5;
  }
  return at;
}

TEST(LaneEffect, OfASensorAddsToItsOwnChannelOnly) {
  LaneInstant const at = some_instant();
  struct {
    LaneEffectMaker make;
    bool is_torque;
  } const cases[] = {{sensor_drift(), true}, {eccentricity(), false}};
  for (auto const& [make, is_torque] : cases) {
    auto const [demand, position, torque] = answer(make, at);
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
      EXPECT_EQ(demand.smooth[lane], 0.0);
      EXPECT_EQ(demand.inertia[lane], 0.0);
      EXPECT_EQ(demand.forward[lane], 0.0);
      EXPECT_EQ(demand.backward[lane], 0.0);
      double const q = at.q[lane];
      EXPECT_NEAR(position[lane], is_torque ? 0.0 : sine * std::sin(q) + cosine * std::cos(q), rounding);
      EXPECT_NEAR(torque[lane], is_torque ? drift * 0.9 + jump : 0.0, rounding);
    }
  }
}

TEST(LaneEffect, OfAJointAddsToNoChannel) {
  LaneInstant const at = some_instant();
  auto const [demand, position, torque] = answer(lane_effect(*find_effect("viscous"), {0.2}, {}), at);
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    EXPECT_NEAR(demand.smooth[lane], 0.2 * at.dq[lane], rounding);
    EXPECT_EQ(position[lane], 0.0);
    EXPECT_EQ(torque[lane], 0.0);
  }
}

// as in the columns of the model, between two ticks as a straight line
TEST(LaneEffect, FollowsTheGearLoadOfItsRecording) {
  LaneInstant at = some_instant();
  at.time_s = 0.25;
  auto const load = std::make_shared<Eigen::VectorXd const>(Eigen::Vector3d(1.0, 3.0, -5.0));
  double const mu = 0.1;
  auto const forward_at = [&](double time_s) {
    at.time_s = time_s;
    return answer(lane_effect(*find_effect("load_dependent_friction"), {mu, 1.0, 0.0}, {}, {{}, load, 2.0}), at)
        .demand.forward[0];
  };
  EXPECT_NEAR(forward_at(0.25), mu * 2.0, rounding);
  EXPECT_NEAR(forward_at(1.0), mu * 5.0, rounding);
  EXPECT_NEAR(forward_at(7.0), mu * 5.0, rounding) << "as at the end";
}

// a fault of the torque channel is one of all that the motor gives: a cubic of it, held as the channel holds it
TEST(LaneEffect, FollowsTheWholeTorqueOfTheMotor) {
  LaneInstant at = some_instant();
  at.time_s = 0.5;
  at.step_s = 0.5;
  auto const load = std::make_shared<Eigen::VectorXd const>(Eigen::Vector3d(1.0, 3.0, -5.0));
  std::vector<double> const limits{1.0, 2.0, 2.0};  // all of what is beyond 2 N m is not shown
  auto const shown = answer(lane_effect(*find_effect("clipping"), limits, {}, {{}, load, 2.0}), at);
  // the motor holds its own 0.5 N m and what the load is a quarter of a second later, -1 N m
  EXPECT_NEAR(shown.torque[0], 0.0, rounding);
  at.time_s = 0.25;
  auto const clipped = answer(lane_effect(*find_effect("clipping"), limits, {}, {{}, load, 2.0}), at);
  EXPECT_NEAR(clipped.torque[0], 2.0 - 3.5, rounding);
}

TEST(SensorDrift, ShiftsTheLoggedTorqueAndNothingElse) {
  // in a closed loop: a controller that saw it would answer
  ReplicateGroup const plain = simulated(closed_loop(), track(0.8), {}),
                       drifted = simulated(closed_loop(), track(0.8), {sensor_drift()});
  ASSERT_GT(plain.position[0].maxCoeff(), 0.5);
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    EXPECT_EQ(drifted.position[lane], plain.position[lane]);
    for (Eigen::Index k = 0; k < samples; ++k) {
      double const time_s = static_cast<double>(k) / rate_hz;
      double const shift = drift * time_s + (k >= 850 ? jump : 0.0);
      ASSERT_NEAR(drifted.torque[lane][k] - plain.torque[lane][k], shift, rounding) << k;
    }
  }
}

TEST(EncoderEccentricity, ShiftsTheReadingOfAMotionThatIsTheSame) {
  // position noise is read with the error, and is none of the angle
  ReplicateLoop loop = blind_loop();
  loop.position_noise_std = 0.0;
  ReplicateGroup const plain = simulated(loop, track(1.6), {}), shifted = simulated(loop, track(1.6), {eccentricity()});
  ASSERT_GT(plain.position[0].maxCoeff() - plain.position[0].minCoeff(), 1.0);
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    EXPECT_EQ(shifted.torque[lane], plain.torque[lane]);
    // the first reading is the recorded one, so the joint itself begins off by the error there; nothing else pulls it
    // on
    double const start = shifted.position[lane][0];
    EXPECT_NEAR(start, plain.position[lane][0], 1e-4);
    double const off = reading_error(plain.position[lane].head(1))[0];
    Eigen::VectorXd const angle = plain.position[lane].array() - off;
    EXPECT_LT((shifted.position[lane] - angle - reading_error(angle)).cwiseAbs().maxCoeff(), rounding);
  }
}

TEST(EncoderEccentricity, IsSeenByTheController) {
  ReplicateLoop loop = closed_loop();
  loop.torque_noise = white(0.0);
  ReplicateGroup const plain = simulated(loop, track(0.8), {}), shifted = simulated(loop, track(0.8), {eccentricity()});
  Eigen::VectorXd const answer = shifted.torque[0] - plain.torque[0];
  EXPECT_GT(answer.cwiseAbs().maxCoeff(), 0.01);
  // the loop keeps the reading where it was: the joint itself goes wrong by the error
  double const reading = (shifted.position[0] - plain.position[0]).tail(samples / 2).norm();
  EXPECT_LT(reading, 0.5 * reading_error(plain.position[0]).tail(samples / 2).norm());
}

TEST(Backlash, OfALoadHeavierThanItsMotorDoesNotRunAway) {
  // pushed for a while in no friction: motor and load end up at the speed that the push gave to their sum, as slowly as
  // the gap lets them
  double const inertia = 0.04, push = 2.0;
  Eigen::Index const pushed = 20;
  ReplicateLoop loop = blind_loop();
  loop.torque_noise = white(0.0);
  loop.position_noise_std = 0.0;
  ReplicateTrack pulse = track(0.0);
  pulse.reference.resize(3 * samples);
  pulse.reference.setZero();
  pulse.reference.head(pushed).setConstant(push);
  double const together = push * static_cast<double>(pushed) / rate_hz / inertia;
  for (double const share : {0.1, 0.5, 0.9, 0.97}) {
    ReplicateJoint joint;
    joint.lanes = {inertia, 0.0, 0.0, 0.0};
    joint.effects = {lane_effect(*find_effect("backlash"), {share * inertia, 1e-3, 60.0, 0.3, 20.0, 0.0}, {})};
    ReplicateGroup group;
    ReplicateSimulator(joint, loop, pulse, 1e-4).simulate({5, 0, 0}, 0, group);
    auto const& q = group.position[0];
    double const speed = (q[q.size() - 1] - q[q.size() - 1 - samples]) * rate_hz / static_cast<double>(samples);
    EXPECT_NEAR(speed / together, 1.0, 0.02) << share;
  }
}

}  // namespace lane_effect_test
