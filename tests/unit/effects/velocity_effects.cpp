// What friction and other effects of the instant do, by themselves.

#include <gtest/gtest.h>

#include <cmath>

#include "engine/effects/effect.hpp"

namespace torquescope {
namespace velocity_effects_test {

JointScales const plain;  // equal Coulomb levels

double torque(std::string const& name, JointState const& state, std::vector<double> const& parameters,
              JointScales const& scales = plain) {
  return find_effect(name)->torque(state, parameters, scales);
}

TEST(SeedEffects, FollowEquation3) {
  JointState const forwards{0.0, 0.5, 2.0, 3.0}, backwards{0.0, 0.5, -2.0, 3.0};
  EXPECT_EQ(torque("inertia", forwards, {0.0036}), 0.0036 * 3.0);
  EXPECT_EQ(torque("viscous", backwards, {0.0164}), -0.0164 * 2.0);
  EXPECT_EQ(torque("coulomb_positive", forwards, {0.0089}), 0.0089);
  EXPECT_EQ(torque("coulomb_positive", backwards, {0.0089}), 0.0);
  EXPECT_EQ(torque("coulomb_negative", forwards, {-0.2582}), 0.0);
  EXPECT_EQ(torque("coulomb_negative", backwards, {-0.2582}), -0.2582);
}

TEST(DryFriction, IsZeroAtRest) {
  JointState const rest{0.0, 0.5, 0.0, 3.0, 0.7, 0.9};
  for (auto const* name : {"coulomb", "coulomb_positive", "coulomb_negative"})
    EXPECT_EQ(torque(name, rest, {1.0}), 0.0) << name;
  EXPECT_EQ(torque("load_dependent_friction", rest, {1.0, 0.5, 0.0}), 0.0);
  EXPECT_EQ(torque("stribeck", rest, {1.0, 0.1, 1.0}), 0.0);
  EXPECT_EQ(torque("position_dependent_friction", rest, {1.0, 1.0, 1.0, 2.0}), 0.0);
}

TEST(DissipativeEffects, NeverDriveTheJoint) {
  for (double const velocity : {-3.0, -1e-9, 0.0, 1e-9, 3.0}) {
    JointState const state{0.0, 0.2, velocity, 0.0, -0.8, 0.5};
    EXPECT_GE(velocity * torque("viscous", state, {0.02}), 0.0);
    EXPECT_GE(velocity * torque("coulomb", state, {0.1}), 0.0);
    EXPECT_GE(velocity * torque("coulomb_positive", state, {0.1}), 0.0);
    EXPECT_GE(velocity * torque("coulomb_negative", state, {-0.1}), 0.0);
    EXPECT_GE(velocity * torque("stribeck", state, {0.3, 0.01, 1.3}), 0.0);
    EXPECT_GE(velocity * torque("speed_drag", state, {0.3, 0.4}), 0.0);
    EXPECT_GE(velocity * torque("power_law_viscous", state, {0.3, 0.4}), 0.0);
    EXPECT_GE(velocity * torque("load_dependent_friction", state, {0.2, 0.6, 0.4}), 0.0);
    EXPECT_GE(velocity * torque("directional_efficiency", state, {0.2, 0.7, 0.6}), 0.0);
  }
}

TEST(Stribeck, HasItsHeightAtRestAndOneOverEAtItsSpeed) {
  for (double const exponent : {0.5, 1.0, 2.0}) {
    EXPECT_NEAR(torque("stribeck", {.dq = 1e-300}, {0.4, 0.02, exponent}), 0.4, 1e-15);
    EXPECT_NEAR(torque("stribeck", {.dq = -0.02}, {0.4, 0.02, exponent}), -0.4 / std::exp(1.0), 1e-15);
  }
}

TEST(AsymmetricViscous, MakesTwoSlopes) {
  double const viscous = 0.5, asymmetric = 0.1;
  for (double const velocity : {-2.0, 1.3}) {
    double const slope = velocity > 0.0 ? 0.6 : 0.4;
    EXPECT_NEAR(
        torque("viscous", {.dq = velocity}, {viscous}) + torque("asymmetric_viscous", {.dq = velocity}, {asymmetric}),
        slope * velocity, 1e-15);
  }
}

TEST(PowerLawViscous, IsViscousAtOneAndDragAtTwo) {
  for (double const velocity : {-2.5, 0.3}) {
    EXPECT_NEAR(torque("power_law_viscous", {.dq = velocity}, {0.7, 1.0}), torque("viscous", {.dq = velocity}, {0.7}),
                1e-14);
    EXPECT_NEAR(torque("power_law_viscous", {.dq = velocity}, {0.7, 2.0}),
                torque("speed_drag", {.dq = velocity}, {0.7, 0.0}), 1e-14);
  }
}

TEST(ModulatedFriction, IsInProportionToTheCoulombLevelOfItsDirection) {
  JointScales unequal;
  unequal.coulomb_positive = 0.3;
  unequal.coulomb_negative = 0.5;
  JointState forwards{1.0, 0.4, 0.01, 2.0, 0.8, 0.0};
  auto backwards = forwards;
  backwards.dq = -0.01;
  std::vector<std::pair<char const*, std::vector<double>>> const modulated{
      {"stribeck", {1.0, 0.1, 1.0}},
      {"position_dependent_friction", {1.0, 2.0, 3.0, 4.0}},
      {"load_dependent_friction", {0.1, 0.5, 0.3}},
      {"thermal_friction", {1.0, 0.0, 9.0}},
      {"friction_drift", {1.0, 0.0, 2.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.5}}};
  for (auto const& [name, parameters] : modulated)
    EXPECT_NEAR(torque(name, forwards, parameters, unequal) / 0.3, -torque(name, backwards, parameters, unequal) / 0.5,
                1e-14)
        << name;
}

TEST(LoadDependentFriction, FollowsTheSizeOfTheLoadAlone) {
  double const up = torque("load_dependent_friction", {.dq = 1.0, .load_torque = 2.0}, {0.1, 1.0, 0.0});
  EXPECT_NEAR(up, 0.2, 1e-15);
  EXPECT_EQ(up, torque("load_dependent_friction", {.dq = 1.0, .load_torque = -2.0}, {0.1, 1.0, 0.0}));
}

// a load of 3 at right angles to a preload of 4 presses with 5; the 4 are in the Coulomb level already
TEST(LoadDependentFriction, AddsTheLoadToWhatPressesAnyway) {
  JointState const state{.dq = 1.0, .load_torque = -3.0};
  EXPECT_NEAR(torque("load_dependent_friction", state, {0.1, 1.0, 4.0}), 0.1 * (5.0 - 4.0), 1e-15);
  EXPECT_EQ(torque("load_dependent_friction", {.dq = 1.0}, {0.1, 1.0, 4.0}), 0.0);
}

// a rotor before the gear is half of the inertia: it presses no teeth
TEST(LoadDependentFriction, FeelsOnlyTheInertiaBehindTheGear) {
  JointScales scales;
  scales.inertia = 0.4;
  JointState const state{.dq = 1.0, .ddq = 5.0, .load_torque = 1.0 + 0.4 * 5.0};
  EXPECT_NEAR(torque("load_dependent_friction", state, {0.1, 0.5, 0.0}, scales), 0.1 * (1.0 + 0.2 * 5.0), 1e-15);
  EXPECT_NEAR(torque("directional_efficiency", {.dq = 1.0, .ddq = 5.0, .load_torque = 3.0, .motor_torque = 3.5},
                     {0.1, 1.0, 0.5}, scales),
              0.1 * (3.5 - 2.0), 1e-15);
}

TEST(DirectionalEfficiency, LosesMoreWhereTheMotorDrivesThanWhereItBrakes) {
  // the motor lifts 2 N m with 2.5, and lowers it with 1.5: friction of 0.5 helps it
  double const driving =
      torque("directional_efficiency", {.dq = 1.0, .load_torque = 2.0, .motor_torque = 2.5}, {0.1, 0.0, 1.0});
  double const driven =
      torque("directional_efficiency", {.dq = -1.0, .load_torque = 2.0, .motor_torque = 1.5}, {0.1, 0.0, 1.0});
  EXPECT_NEAR(driving, 0.25, 1e-15);
  EXPECT_NEAR(driven, -0.15, 1e-15);
}

TEST(ThermalFriction, IsColdAtTheStartAndFadesWithItsTime) {
  JointScales scales;
  scales.start_s = 5.0;
  EXPECT_NEAR(torque("thermal_friction", {.time_s = 5.0, .dq = 2.0}, {0.3, 0.1, 40.0}, scales), 0.3 + 0.2, 1e-15);
  EXPECT_NEAR(torque("thermal_friction", {.time_s = 45.0, .dq = 2.0}, {0.3, 0.1, 40.0}, scales), 0.5 / std::exp(1.0),
              1e-15);
}

TEST(FrictionDrift, IsARampAndAStep) {
  std::vector<double> const parameters{0.01, 0.002, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 30.0};
  EXPECT_NEAR(torque("friction_drift", {.time_s = 29.0, .dq = -2.0}, parameters), -29.0 * (0.01 + 0.004), 1e-15);
  EXPECT_NEAR(torque("friction_drift", {.time_s = 30.0, .dq = -2.0}, parameters), -30.0 * (0.01 + 0.004) - 0.1, 1e-15);
}

// the wander says nothing about level and ramp: Legendre's polynomials, by their closed forms and by their products
TEST(FrictionDrift, WandersBesideLevelAndRamp) {
  JointScales scales;
  scales.start_s = 3.0;
  scales.duration_s = 40.0;
  auto const wander = [&](int degree, double time_s) {
    std::vector<double> parameters(9, 0.0);
    parameters[static_cast<std::size_t>(degree) + 1] = 1.0;
    return torque("friction_drift", {.time_s = time_s, .dq = 2.0}, parameters, scales);
  };
  double const x = 0.3, time_s = 3.0 + 40.0 * 0.5 * (1.0 + x);
  EXPECT_NEAR(wander(2, time_s), (3.0 * x * x - 1.0) / 2.0, 1e-14);
  EXPECT_NEAR(wander(3, time_s), (5.0 * x * x * x - 3.0 * x) / 2.0, 1e-14);
  EXPECT_NEAR(wander(6, time_s), (231.0 * std::pow(x, 6) - 315.0 * std::pow(x, 4) + 105.0 * x * x - 5.0) / 16.0, 1e-14);
  constexpr int parts = 4000;
  for (int degree = 2; degree <= 6; ++degree) {
    double level = 0.0, ramp = 0.0;
    for (int i = 0; i < parts; ++i) {
      double const share = (i + 0.5) / parts, value = wander(degree, 3.0 + 40.0 * share);
      level += value / parts;
      ramp += value * share / parts;
    }
    EXPECT_NEAR(level, 0.0, 1e-5) << degree;
    EXPECT_NEAR(ramp, 0.0, 1e-5) << degree;
  }
}

TEST(Contact, ActsInItsWindowOnlyAndHasHalfItsHeightOnAverage) {
  std::vector<double> const parameters{3.0, 2.0, 0.5};
  EXPECT_EQ(torque("contact", {.time_s = 2.0}, parameters), 0.0);
  EXPECT_EQ(torque("contact", {.time_s = 2.5}, parameters), 0.0);
  EXPECT_NEAR(torque("contact", {.time_s = 2.25}, parameters), 3.0, 1e-15);
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i) sum += torque("contact", {.time_s = 2.0 + 0.0005 * i}, parameters) * 0.0005;
  EXPECT_NEAR(sum, 3.0 * 0.5 / 2.0, 1e-12);  // trapezoids are exact for a full period
}

TEST(PeriodicDisturbance, KeepsItsFrequencyWhateverTheJointDoes) {
  std::vector<double> const parameters{0.4, -0.3, 12.5};
  double const once = torque("periodic_disturbance", {.time_s = 0.033, .q = 1.0, .dq = 2.0}, parameters);
  EXPECT_NEAR(torque("periodic_disturbance", {.time_s = 0.033 + 1.0 / 12.5}, parameters), once, 1e-14);
  EXPECT_NEAR(torque("periodic_disturbance", {.time_s = 0.033 + 0.5 / 12.5}, parameters), -once, 1e-14);
}

}  // namespace velocity_effects_test
}  // namespace torquescope
