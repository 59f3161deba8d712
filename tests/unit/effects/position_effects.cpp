// What effects that live in the angle do; images of errors of the angle against the exact thing.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/effects/smooth_motion.hpp"

namespace torquescope {
namespace position_effects_test {

JointScales const plain;

double torque(std::string const& name, JointState const& state, std::vector<double> const& parameters,
              JointScales const& scales = plain) {
  return find_effect(name)->torque(state, parameters, scales);
}

TEST(Gravity, IsTheSlopeOfAPotential) {
  // centre of mass anywhere: U = -g_sin cos(q) + g_cos sin(q)
  double const g_sin = 1.7, g_cos = -0.4, step = 1e-6;
  auto const potential = [&](double q) { return -g_sin * std::cos(q) + g_cos * std::sin(q); };
  for (double q = -3.0; q < 3.0; q += 0.37) {
    double const slope = (potential(q + step) - potential(q - step)) / (2.0 * step);
    EXPECT_NEAR(torque("gravity", {0.0, q, 1.0, 1.0}, {g_sin, g_cos}), slope, 1e-9);  // step^2 and rounding / step
  }
}

// what a spring between two weights of different stiffness would be: the same about its rest to both sides, stiffer
// away from it
TEST(Spring, HardensAwayFromItsRest) {
  double const k = 2.0, hardening = 0.3, rest = -0.4, step = 1e-5;
  auto const at = [&](double q) { return torque("spring", {.q = q}, {k, hardening, rest}); };
  auto const stiffness = [&](double q) { return (at(q + step) - at(q - step)) / (2.0 * step); };
  EXPECT_NEAR(stiffness(rest), k, 1e-8);  // step^2 and rounding / step
  EXPECT_NEAR(stiffness(rest + 1.5), k * (1.0 + 3.0 * hardening * 2.25), 1e-7);
  EXPECT_NEAR(at(rest + 1.1) - at(rest), at(rest) - at(rest - 1.1), 1e-12);
  EXPECT_EQ(torque("spring", {.q = 0.7}, {k}), k * 0.7);  // plain
  EXPECT_EQ(torque("spring", {.q = 0.7}, {k, 0.0, rest}), k * 0.7);
}

TEST(EndStop, PushesBackAtItsOwnEndOnly) {
  JointScales scales;
  scales.position_centre = 1.0;
  // upper stop at 1.4, lower stop at 0.6: the motor must push towards the stop
  EXPECT_NEAR(torque("end_stop", {.q = 1.5}, {20.0, 0.0, 1.4, 1.0}, scales), 2.0, 1e-14);
  EXPECT_EQ(torque("end_stop", {.q = 0.2, .dq = 1.0}, {20.0, 3.0, 1.4, 1.0}, scales), 0.0);
  EXPECT_NEAR(torque("end_stop", {.q = 0.5}, {20.0, 0.0, 0.6, 1.0}, scales), -2.0, 1e-14);
  EXPECT_EQ(torque("end_stop", {.q = 1.8, .dq = 1.0}, {20.0, 3.0, 0.6, 1.0}, scales), 0.0);
  EXPECT_NEAR(torque("end_stop", {.q = 0.5, .dq = 2.0}, {0.0, 3.0, 0.6, 1.0}, scales), 6.0, 1e-14);
  // at a hundredth of the travel every power says the same
  double const unit = 0.01 * scales.position_range;
  for (double const power : {1.0, 1.5, 2.0}) {
    EXPECT_NEAR(torque("end_stop", {.q = 1.4 + unit}, {20.0, 0.0, 1.4, power}, scales), 20.0 * unit, 1e-12);
    EXPECT_NEAR(torque("end_stop", {.q = 0.6 - 4.0 * unit}, {20.0, 0.0, 0.6, power}, scales),
                -20.0 * unit * std::pow(4.0, power), 1e-11);
    EXPECT_EQ(torque("end_stop", {.q = 1.4}, {20.0, 0.0, 1.4, power}, scales), 0.0);
  }
}

TEST(Cogging, RepeatsAlongTheAngleAtAnySpeedAndTorque) {
  std::vector<double> const parameters{0.1, 0.2, 18.0};
  double const once = torque("cogging", {.q = 0.3, .dq = 0.1, .motor_torque = 5.0}, parameters);
  double const wave = 2.0 * std::numbers::pi / 18.0;
  EXPECT_NEAR(torque("cogging", {.q = 0.3 + wave, .dq = -4.0, .ddq = 3.0, .motor_torque = 0.0}, parameters), once,
              1e-14);
}

TEST(TorqueRipple, IsInProportionToTheTorque) {
  std::vector<double> const parameters{0.01, 0.02, 18.0};
  double const once = torque("torque_ripple", {.q = 0.3, .motor_torque = 1.0}, parameters);
  EXPECT_NEAR(torque("torque_ripple", {.q = 0.3, .motor_torque = -7.0}, parameters), -7.0 * once, 1e-15);
}

TEST(PayloadChange, IsInertiaAndGravityFromItsInstantOn) {
  JointState state{9.99, 0.7, 0.2, -3.0};
  std::vector<double> const parameters{0.02, 0.3, -0.1, 10.0};
  EXPECT_EQ(torque("payload_change", state, parameters), 0.0);
  state.time_s = 10.0;
  EXPECT_NEAR(torque("payload_change", state, parameters),
              torque("inertia", state, {0.02}) + torque("gravity", state, {0.3, -0.1}), 1e-15);
  JointScales slide;
  slide.joint = JointKind::prismatic;
  EXPECT_NEAR(torque("payload_change", state, parameters, slide), 0.02 * -3.0 - 0.1, 1e-15);
}

// what the joint of the tests asks, without Coulomb friction
double smooth_torque(JointScales const& joint, double q, double dq, double ddq) {
  return joint.inertia * ddq + joint.viscous * dq + joint.gravity_sin * std::sin(q) + joint.gravity_cos * std::cos(q);
}

JointScales known_scales() {
  JointScales scales;
  scales.inertia = 0.05;
  scales.viscous = 0.2;
  scales.gravity_sin = 1.2;
  scales.gravity_cos = -0.4;
  return scales;
}

// q' = q + a cos(n q) + b sin(n q), differentiated along the motion
JointState waved(JointState const& state, double a, double b, double n) {
  double const c = std::cos(n * state.q), s = std::sin(n * state.q);
  double const slope = 1.0 + n * (b * c - a * s), curvature = -n * n * (a * c + b * s);
  auto moved = state;
  moved.q += a * c + b * s;
  moved.dq = slope * state.dq;
  moved.ddq = slope * state.ddq + curvature * state.dq * state.dq;
  return moved;
}

// A first-order image leaves a remainder of second order: a tenth of the error must leave a hundredth of it.
template <class Exact, class Image>
void expect_first_order(Exact exact, Image image) {
  auto const remainder = [&](double size) {
    double sum = 0.0;
    for (double t = 0.0; t < 5.0; t += 0.037) {
      auto const state = test::smooth_state(t);
      sum += std::pow(exact(state, size) - image(state, size), 2);
    }
    return std::sqrt(sum);
  };
  EXPECT_NEAR(remainder(1e-4) / remainder(1e-3), 1e-2, 1e-3);
}

TEST(TransmissionError, IsTheFirstOrderOfALoadThatTurnsUnevenly) {
  auto const joint = known_scales();
  constexpr double order = 6.0;
  auto const exact = [&](JointState const& state, double size) {
    // virtual work: the motor turns the load by dq_load/dq
    auto const load = waved(state, size, 0.6 * size, order);
    double const ratio = 1.0 + order * (0.6 * size * std::cos(order * state.q) - size * std::sin(order * state.q));
    return ratio * smooth_torque(joint, load.q, load.dq, load.ddq) - smooth_torque(joint, state.q, state.dq, state.ddq);
  };
  auto const image = [&](JointState state, double size) {
    state.load_torque = smooth_torque(joint, state.q, 0.0, state.ddq);
    return torque("transmission_error", state, {size, 0.6 * size, order}, joint);
  };
  expect_first_order(exact, image);
}

TEST(EncoderEccentricity, IsTheFirstOrderOfAModelThatBelievesTheReading) {
  auto const joint = known_scales();
  auto const* effect = find_effect("encoder_eccentricity");
  for (int const wave : {1, 2}) {
    auto const exact = [&](JointState const& state, double size) {
      auto const read = waved(state, 0.6 * size, size, wave);
      return smooth_torque(joint, state.q, state.dq, state.ddq) - smooth_torque(joint, read.q, read.dq, read.ddq);
    };
    auto const image = [&](JointState const& state, double size) {
      // what an identification sees: the motion as read
      auto const read = waved(state, 0.6 * size, size, wave);
      Motion const motion = test::motion_of([&](double) { return read; }, 1, 1.0);
      Eigen::MatrixXd phi(1, 4);
      effect->columns({motion, joint}, {}, phi);
      return (phi.middleCols(2 * (wave - 1), 2) * Eigen::Vector2d(size, 0.6 * size))(0);
    };
    expect_first_order(exact, image);
  }
}

TEST(EncoderEccentricity, AddsToThePositionInSimulation) {
  auto const runner = find_effect("encoder_eccentricity")->runner(std::vector<double>{2e-3, 1e-3, 4e-4, 3e-4}, plain);
  EXPECT_EQ(find_effect("encoder_eccentricity")->acts_on(), ActsOn::recorded_position);
  EXPECT_NEAR(runner->torque({.q = 0.7}, 1e-3),
              2e-3 * std::sin(0.7) + 1e-3 * std::cos(0.7) + 4e-4 * std::sin(1.4) + 3e-4 * std::cos(1.4), 1e-18);
}

}  // namespace position_effects_test
}  // namespace torquescope
