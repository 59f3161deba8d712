#include "engine/simulate/arm_simulation_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/simulate/arms.hpp"

namespace torquescope {
namespace arm_simulation_plan_test {

using test::section;
using Numbers = std::vector<double>;

SerialChain limited_arm() {
  auto chain = test::random_arm(8, false, true).chain;
  chain.joints.resize(2);
  chain.links.resize(2);
  chain.joints[0].lower = -1.0;
  chain.joints[0].upper = 2.0;
  chain.joints[0].max_speed = 1.5;
  chain.joints[1].max_torque = 40.0;
  chain.joints[1].encoder_step = 1e-4;
  return chain;
}

struct Read {
  ArmSimulationPlan plan;
  std::vector<Problem> problems;
  bool complains_of(std::string const& word) const {
    return std::any_of(problems.begin(), problems.end(),
                       [&](Problem const& one) { return one.what.find(word) != std::string::npos; });
  }
};

Read read(std::vector<Section> const& sections, SerialChain const& chain = limited_arm()) {
  ArmSimulationSections named;
  for (auto const& one : sections) {
    if (one.name == "simulate") named.simulate.simulate = &one;
    if (one.name == "simulate.plant") named.simulate.plant = &one;
    if (one.name == "simulate.reference") named.simulate.reference = &one;
    if (one.name == "simulate.controller") named.simulate.controller = &one;
    if (one.name == "simulate.noise") named.simulate.noise = &one;
    if (one.name == "simulate.effects") named.effects.push_back(&one);
  }
  Read result;
  result.plan = read_arm_simulation(named, chain, result.problems);
  return result;
}

TEST(ArmSimulationPlan, ListsHoldANumberForEachJoint) {
  auto const made = read({section("simulate", {{"duration_s", 2.0}}),
                          section("simulate.plant", {{"viscous", Numbers{0.5, 1.5}}, {"coulomb", 0.2}}),
                          section("simulate.controller", {{"bandwidth_hz", Numbers{3.0, 4.5}}}),
                          section("simulate.noise", {{"torque_std", Numbers{1.0, 0.25}}})});
  ASSERT_TRUE(made.problems.empty()) << made.problems.front().what;
  EXPECT_EQ(made.plan.joints[1].controller.bandwidth_hz, 4.5);
  EXPECT_EQ(made.plan.joints[0].noise.torque_std, 1.0);
  auto const truth = truth_values(made.plan);
  auto const value = [&](std::string const& name) {
    return std::find_if(truth.begin(), truth.end(), [&](TruthValue const& one) { return one.name == name; })->value;
  };
  EXPECT_EQ(value("viscous_2"), 1.5);
  EXPECT_EQ(value("coulomb_1"), 0.2);
  EXPECT_EQ(value("coulomb_2"), 0.2);
}

TEST(ArmSimulationPlan, RobotFileGivesWhatTheJobLeavesOut) {
  auto const made = read({section("simulate")});
  ASSERT_TRUE(made.problems.empty()) << made.problems.front().what;
  EXPECT_EQ(made.plan.joints[0].reference.centre, 0.5);
  EXPECT_EQ(made.plan.joints[0].reference.amplitude, 1.5);
  EXPECT_EQ(made.plan.joints[0].reference.max_speed, 1.5);
  EXPECT_EQ(made.plan.joints[1].controller.torque_limit, 40.0);
  EXPECT_EQ(made.plan.joints[1].encoder.step, 1e-4);
  EXPECT_EQ(made.plan.simulation.step_s, 2.5e-4);
}

TEST(ArmSimulationPlan, AnyEffectStandsAtAnyJoint) {
  auto const made = read({section("simulate"), section("simulate.plant", {{"coulomb", 1.0}}),
                          section("simulate.effects", {{"joint", std::int64_t{2}},
                                                       {"name", std::string("stribeck")},
                                                       {"stribeck", 0.4},
                                                       {"stribeck_speed", 0.1},
                                                       {"stribeck_exponent", 1.0}}),
                          section("simulate.effects", {{"joint", std::int64_t{1}},
                                                       {"name", std::string("presliding")},
                                                       {"presliding", 0.5},
                                                       {"presliding_damping", 0.0},
                                                       {"presliding_distance", 1e-3}})});
  ASSERT_TRUE(made.problems.empty()) << made.problems.front().what;
  EXPECT_EQ(made.plan.joints[1].terms.instant.size(), 2u);
  EXPECT_TRUE(made.plan.joints[1].terms.remembering.empty());
  EXPECT_EQ(made.plan.joints[0].terms.remembering.size(), 1u);
}

TEST(ArmSimulationPlan, SaysWhatIsWrong) {
  EXPECT_TRUE(read({section("simulate"), section("simulate.plant", {{"viscous", Numbers{1.0, 2.0, 3.0}}})})
                  .complains_of("holds 3 numbers, but the arm has 2 joints"));
  EXPECT_TRUE(read({section("simulate"), section("simulate.effects", {{"name", std::string("stribeck")}})})
                  .complains_of("at which joint"));
  EXPECT_TRUE(read({section("simulate"),
                    section("simulate.effects", {{"joint", std::int64_t{1}}, {"name", std::string("stribek")}})})
                  .complains_of("no effect is called \"stribek\""));
  EXPECT_TRUE(read({section("simulate"),
                    section("simulate.effects",
                            {{"joint", std::int64_t{1}}, {"name", std::string("stribeck")}, {"viscous", 1.0}})})
                  .complains_of("stands beside"));
  EXPECT_TRUE(read({section("simulate"), section("simulate.plant", {{"coulomb", Numbers{1.0, -1.0}}})})
                  .complains_of("would drive the joint"));
  auto const twice = read({section("simulate"), section("simulate.noise", {{"torque_sd", 0.1}})});
  EXPECT_EQ(twice.problems.size(), 1u);  // not once a joint
  auto without_masses = limited_arm();
  without_masses.links.clear();
  EXPECT_TRUE(read({section("simulate")}, without_masses).complains_of("has no masses"));
}

}  // namespace arm_simulation_plan_test
}  // namespace torquescope
