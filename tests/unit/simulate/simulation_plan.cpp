#include "engine/simulate/simulation_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/simulate/plants.hpp"

using namespace torquescope;
using testing::HasSubstr;
using torquescope::test::section;

namespace simulation_plan_test {

Section const plant = section("simulate.plant", {{"inertia", 0.1}, {"coulomb", 0.2}});

struct Reading {
  SimulationPlan plan;
  std::vector<Problem> problems;
};

Reading read(SimulationSections sections, JointKind joint = JointKind::revolute) {
  Reading reading;
  reading.plan = read_simulation(sections, joint, reading.problems);
  return reading;
}

TEST(SimulationPlan, APlantIsEnough) {
  auto const reading = read({.plant = &plant});
  EXPECT_TRUE(reading.problems.empty());
  EXPECT_EQ(reading.plan.simulation.mode, "closed_loop");
  EXPECT_EQ(reading.plan.simulation.samples(), 10000);
  EXPECT_EQ(reading.plan.plant.size(), 2u);
}

TEST(SimulationPlan, TakesEverySection) {
  auto const simulate = section("simulate", {{"rate_hz", 500.0}, {"duration_s", 4.0}, {"seed", std::int64_t{7}}});
  auto const reference = section("simulate.reference", {{"kind", std::string("sine")}, {"max_speed", 0.5}});
  auto const controller = section("simulate.controller", {{"kind", std::string("pid")}});
  auto const encoder = section("simulate.encoder", {{"counts_per_revolution", std::int64_t{4096}}});
  auto const noise = section("simulate.noise", {{"torque_std", 0.02}});
  auto const reading = read({&simulate, &plant, &reference, &controller, &encoder, &noise});
  EXPECT_TRUE(reading.problems.empty());
  EXPECT_EQ(reading.plan.simulation.samples(), 2000);
  EXPECT_EQ(reading.plan.simulation.seed, 7);
  EXPECT_EQ(reading.plan.reference.kind, "sine");
  EXPECT_EQ(reading.plan.controller.kind, "pid");
  EXPECT_EQ(reading.plan.encoder.counts_per_revolution, 4096.0);
  EXPECT_EQ(reading.plan.noise.torque_std, 0.02);
}

TEST(SimulationPlan, ReportsAllProblemsAtOnce) {
  auto const simulate = section("simulate", {{"rate_hz", -5.0}});
  auto const misspelt = section("simulate.plant", {{"inertai", 0.1}});
  auto const reference = section("simulate.reference", {{"kind", std::string("sinus")}});
  auto const noise = section("simulate.noise", {{"torque_sd", 0.1}});
  auto const reading = read({&simulate, &misspelt, &reference, nullptr, nullptr, &noise});
  ASSERT_EQ(reading.problems.size(), 4u);
  for (auto const& problem : reading.problems) {
    EXPECT_EQ(problem.code, ExitCode::bad_job);
    EXPECT_FALSE(problem.help.empty());
    EXPECT_THAT(problem.key, HasSubstr("simulate"));
  }
}

TEST(SimulationPlan, AMissingPlantIsAProblem) {
  auto const simulate = section("simulate");
  auto const reading = read({.simulate = &simulate});
  ASSERT_EQ(reading.problems.size(), 1u);
  EXPECT_THAT(reading.problems[0].what, HasSubstr("simulate.plant"));
}

TEST(SimulationPlan, RefusesWhatTheModeWouldIgnore) {
  auto const inverse = section("simulate", {{"mode", std::string("inverse_dynamics")}});
  auto const encoder = section("simulate.encoder", {{"step", 0.01}});
  auto const controller = section("simulate.controller");
  auto const in_loop = section("simulate.noise", {{"disturbance_std", 0.1}});
  auto const orthogonal = section("simulate.noise", {{"orthogonal_mse", 0.1}});
  auto const both = section("simulate.noise", {{"orthogonal_mse", 0.1}, {"torque_std", 0.1}});
  EXPECT_EQ(read({.simulate = &inverse, .plant = &plant, .noise = &orthogonal}).problems.size(), 0u);
  EXPECT_EQ(
      read({.simulate = &inverse, .plant = &plant, .controller = &controller, .encoder = &encoder}).problems.size(),
      2u);
  EXPECT_EQ(read({.simulate = &inverse, .plant = &plant, .noise = &in_loop}).problems.size(), 1u);
  EXPECT_EQ(read({.simulate = &inverse, .plant = &plant, .noise = &both}).problems.size(), 1u);
  EXPECT_EQ(read({.plant = &plant, .noise = &orthogonal}).problems.size(), 1u);
}

TEST(SimulationPlan, InverseDynamicsNeedsNoInertia) {
  auto const inverse = section("simulate", {{"mode", std::string("inverse_dynamics")}});
  auto const friction = section("simulate.plant", {{"viscous", 0.1}});
  EXPECT_TRUE(read({.simulate = &inverse, .plant = &friction}).problems.empty());
  EXPECT_EQ(read({.plant = &friction}).problems.size(), 1u);
}

TEST(SimulationPlan, APrismaticJointHasNoRevolutions) {
  auto const counts = section("simulate.encoder", {{"counts_per_revolution", 4096.0}});
  EXPECT_EQ(read({.plant = &plant, .encoder = &counts}, JointKind::prismatic).problems.size(), 1u);
  auto const step = section("simulate.encoder", {{"step", 1e-6}});
  EXPECT_TRUE(read({.plant = &plant, .encoder = &step}, JointKind::prismatic).problems.empty());
}

TEST(SimulationPlan, RefusesRecordingsTooShortOrTooLong) {
  auto const few = section("simulate", {{"rate_hz", 2.5}, {"duration_s", 1.0}});
  auto const many = section("simulate", {{"rate_hz", 1e6}, {"duration_s", 1e6}});
  EXPECT_GE(read({.simulate = &few, .plant = &plant}).problems.size(), 1u);
  EXPECT_EQ(read({.simulate = &many, .plant = &plant}).problems.size(), 1u);
}

}  // namespace simulation_plan_test
