#include "engine/simulate/plant_parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "unit/simulate/plants.hpp"

using namespace torquescope;
using testing::HasSubstr;
using torquescope::test::section;

namespace plant_parameters_test {

using Parameters = std::initializer_list<std::pair<std::string, OptionValue>>;

std::vector<Problem> problems_of(Parameters parameters, JointKind joint = JointKind::revolute) {
  std::vector<Problem> problems;
  read_plant(section("simulate.plant", parameters), joint, problems);
  return problems;
}

std::vector<Problem> dynamics_problems_of(Parameters parameters, double step_s = 20e-6) {
  std::vector<Problem> problems;
  auto const written = section("simulate.plant", parameters);
  check_plant_dynamics(read_plant(written, JointKind::revolute, problems), 0.0, step_s, written, problems);
  return problems;
}

TEST(PlantParameters, KeepTheirValuesAndUnits) {
  auto const truth = truth_values(torquescope::test::seed_plant(), JointKind::revolute);
  ASSERT_EQ(truth.size(), 4u);
  EXPECT_EQ(truth[0].name, "inertia");
  EXPECT_EQ(truth[0].value, 0.0036);
  EXPECT_EQ(truth[3].name, "coulomb_negative");
  EXPECT_EQ(truth[3].value, -0.2582);
  EXPECT_EQ(truth[3].unit, "N m");
}

TEST(PlantParameters, WholeNumbersAreNumbers) {
  EXPECT_TRUE(problems_of({{"inertia", std::int64_t{2}}, {"offset", std::int64_t{-1}}}).empty());
}

TEST(PlantParameters, UnwrittenLinearParametersOfAnEffectAreZero) {
  auto const terms = torquescope::test::plant({{"inertia", 0.1}, {"gravity_cos", 3.0}});
  ASSERT_EQ(terms.size(), 2u);
  EXPECT_EQ(terms[1].parameters, (std::vector<double>{0.0, 3.0}));
}

TEST(PlantParameters, MisspeltNamesGetASuggestion) {
  auto const problems = problems_of({{"inertia", 0.1}, {"viscos", 0.1}});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "simulate.plant.viscos");
  EXPECT_THAT(problems[0].caret_note, HasSubstr("viscous"));
}

TEST(PlantParameters, RefuseWhatIsNoNumber) {
  EXPECT_EQ(problems_of({{"inertia", std::string("heavy")}}).size(), 1u);
  EXPECT_EQ(problems_of({{"inertia", std::numeric_limits<double>::quiet_NaN()}}).size(), 1u);
  EXPECT_EQ(problems_of({}).size(), 1u);
}

TEST(PlantParameters, NeedTheShapeOfAControllerThatHasOne) {
  EXPECT_TRUE(problems_of({{"stribeck", 0.1}, {"stribeck_speed", 0.02}, {"stribeck_exponent", 1.0}}).empty());
  auto const missing = problems_of({{"stribeck", 0.1}, {"stribeck_exponent", 1.0}});
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_THAT(missing[0].what, HasSubstr("needs its parameter stribeck_speed"));
  auto const negative = problems_of({{"stribeck", 0.1}, {"stribeck_speed", -0.02}, {"stribeck_exponent", 1.0}});
  ASSERT_EQ(negative.size(), 1u);
  EXPECT_THAT(negative[0].what, HasSubstr("not above 0"));
}

TEST(PlantParameters, AreOfThePlainFormWhereNoShapeIsWritten) {
  auto const terms = torquescope::test::plant({{"inertia", 0.1}, {"spring", 0.8}});
  ASSERT_EQ(terms.size(), 2u);
  EXPECT_EQ(terms[1].effect->torque({.q = 0.5}, terms[1].parameters, {}), 0.4);
  EXPECT_TRUE(problems_of({{"inertia", 0.1}, {"spring", 0.8}, {"spring_hardening", 0.2}}).empty());
}

TEST(PlantParameters, RefuseEffectsThatThePlantCannotHold) {
  for (auto const* name : {"maxwell_slip_2", "delay", "actuator_lag", "load_dependent_friction", "sensor_drift"}) {
    auto const problems = problems_of({{"inertia", 0.1}, {name, 0.1}});
    ASSERT_EQ(problems.size(), 1u) << name;
    EXPECT_THAT(problems[0].what, HasSubstr("cannot be part of the plant"));
    EXPECT_EQ(problems[0].key, std::string("simulate.plant.") + name);
  }
}

TEST(PlantParameters, ASlideHasNoAngle) {
  EXPECT_TRUE(problems_of({{"inertia", 0.1}}, JointKind::prismatic).empty());
  EXPECT_EQ(problems_of({{"inertia", 0.1}, {"gravity_sin", 1.0}}, JointKind::prismatic).size(), 1u);
}

TEST(PlantDynamics, NeedAnInertiaAboveZero) {
  EXPECT_TRUE(dynamics_problems_of({{"inertia", 0.1}}).empty());
  for (auto const& problems : {dynamics_problems_of({{"viscous", 0.1}}), dynamics_problems_of({{"inertia", -0.1}})}) {
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].key, "simulate.plant.inertia");
  }
}

TEST(PlantDynamics, RefuseFrictionThatDrives) {
  auto const problems = dynamics_problems_of({{"inertia", 0.1}, {"coulomb_positive", 0.1}, {"coulomb_negative", 0.2}});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].help, HasSubstr("signs"));
  // levels of one sign are a joint with an offset larger than its friction: it moves by itself, friction still brakes
  EXPECT_TRUE(dynamics_problems_of({{"inertia", 0.1}, {"coulomb_positive", 0.2}, {"coulomb_negative", 0.1}}).empty());
}

TEST(PlantDynamics, RefuseDecayFasterThanTheStep) {
  EXPECT_TRUE(dynamics_problems_of({{"inertia", 0.1}, {"viscous", 10.0}}, 1e-3).empty());
  EXPECT_EQ(dynamics_problems_of({{"inertia", 0.1}, {"viscous", 1000.0}}, 1e-3).size(), 1u);
}

}  // namespace plant_parameters_test
