#include "engine/effects/regressor.hpp"

#include <gmock/gmock.h>

#include "engine/base/error.hpp"
#include "engine/effects/model_options.hpp"
#include "unit/effects/rich_motion.hpp"

namespace torquescope {
namespace regressor_test {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> const seed_terms{"inertia", "viscous", "coulomb_positive", "coulomb_negative"};

std::vector<Problem> problems_of(std::vector<std::string> const& terms, JointKind joint = JointKind::revolute) {
  try {
    Regressor const regressor(terms, joint);
  } catch (Error const& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_job);
    return error.problems();
  }
  return {};
}

TEST(Regressor, ColumnsTimesParametersIsTorqueAtEverySample) {
  Regressor const regressor({"inertia", "viscous", "coulomb", "offset", "gravity"}, JointKind::revolute, 0.4);
  auto const motion = test::rich_motion(80);
  std::vector<double> const parameters{0.3, 0.7, 1.1, -0.2, 2.0, -0.6};
  Eigen::VectorXd const tau = regressor.columns(motion) * Eigen::Map<Eigen::VectorXd const>(parameters.data(), 6);
  for (Eigen::Index i = 0; i < 80; ++i)
    EXPECT_NEAR(tau[i], regressor.torque(test::state_at(motion, i), parameters), 1e-13);
}

TEST(Regressor, KnowsNamesUnitsAndOwnersOfItsColumns) {
  Regressor const regressor({"inertia", "gravity", "viscous"}, JointKind::revolute);
  EXPECT_THAT(regressor.names(), ElementsAre("inertia", "gravity_sin", "gravity_cos", "viscous"));
  EXPECT_THAT(regressor.units(), ElementsAre("kg m2", "N m", "N m", "N m s/rad"));
  EXPECT_EQ(regressor.equation(), "tau = J ddq + g_sin sin(q) + g_cos cos(q) + Fv dq");
  auto const& owners = regressor.column_owners();
  EXPECT_EQ(regressor.terms()[owners[2].term]->name(), "gravity");
  EXPECT_EQ(regressor.terms()[owners[3].term]->name(), "viscous");
}

TEST(Regressor, KnowsWhichPartOfTheMotionEachColumnNeeds) {
  Regressor const regressor({"inertia", "gravity", "coulomb", "offset"}, JointKind::revolute);
  auto const& columns = regressor.column_owners();
  EXPECT_TRUE(columns[0].needs_acceleration && !columns[0].needs_velocity && !columns[0].needs_position);
  EXPECT_TRUE(columns[1].needs_position && !columns[1].needs_velocity);
  EXPECT_TRUE(columns[3].needs_velocity && !columns[3].needs_position);
  EXPECT_FALSE(columns[4].needs_position || columns[4].needs_velocity || columns[4].needs_acceleration);
}

TEST(Regressor, HasForceUnitsOnASlide) {
  Regressor const regressor(seed_terms, JointKind::prismatic);
  EXPECT_THAT(regressor.units(), ElementsAre("kg", "N s/m", "N", "N"));
  EXPECT_THAT(regressor.equation(), HasSubstr("F = J ddq"));
}

TEST(Regressor, RefusesGravityOnASlideAndNamesTheConstantInstead) {
  auto const problems = problems_of({"inertia", "gravity"}, JointKind::prismatic);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].what, HasSubstr("needs an angle"));
  EXPECT_THAT(problems[0].help, HasSubstr("\"offset\""));
}

TEST(Regressor, RefusesWhatLeastSquaresOnTheMotionCannotFitAndSaysWhy) {
  auto const what = [](std::string const& term) {
    auto const problems = problems_of({"inertia", term});
    EXPECT_EQ(problems.size(), 1u) << term;
    EXPECT_THAT(problems[0].help, HasSubstr("torquescope diagnose"));
    return problems[0].what;
  };
  EXPECT_EQ(
      what("stribeck"),
      "\"stribeck\" cannot be a term of the model: its torque is not linear in stribeck_speed, stribeck_exponent");
  EXPECT_THAT(what("torque_constant"), HasSubstr("built on the torque of a fitted model"));
  EXPECT_THAT(what("actuator_lag"), HasSubstr("depends on what happened before"));
  EXPECT_THAT(what("encoder_eccentricity"), HasSubstr("recorded channel"));
}

TEST(Regressor, HoldsThePlainFormOfAnEffectThatHasShapes) {
  Regressor const regressor({"inertia", "spring"}, JointKind::revolute);
  EXPECT_THAT(regressor.names(), ElementsAre("inertia", "spring"));
  EXPECT_EQ(regressor.equation(), "tau = J ddq + k q");
  auto const motion = test::rich_motion(20);
  EXPECT_EQ(regressor.columns(motion).col(1), motion.q);
  EXPECT_EQ(regressor.torque({.q = 0.5, .ddq = 2.0}, std::vector<double>{0.1, 0.8}), 0.1 * 2.0 + 0.8 * 0.5);
}

TEST(Regressor, AcceptsEveryEffectThatIsPlain) {
  for (auto const* effect : effect_choices())
    EXPECT_EQ(problems_of({effect->name()}).empty(), effect->is_plain_term()) << effect->name();
}

TEST(Regressor, RefusesEveryCollinearCoulombForm) {
  // sign(dq) = [dq>0] - [dq<0] and 1 = [dq>0] + [dq<0] while the joint moves
  EXPECT_EQ(problems_of({"coulomb_positive", "coulomb_negative", "coulomb"}).size(), 1u);
  EXPECT_EQ(problems_of({"coulomb_positive", "coulomb_negative", "offset"}).size(), 1u);
  EXPECT_EQ(problems_of({"coulomb", "offset", "coulomb_positive"}).size(), 1u);
  EXPECT_EQ(problems_of({"coulomb", "coulomb_positive", "coulomb_negative", "offset"}).size(), 2u);
}

TEST(Regressor, SaysWhichTermsAreCollinearAndHow) {
  auto const problems = problems_of({"viscous", "coulomb_positive", "coulomb_negative", "offset"});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].what,
            "term \"offset\" says nothing new: offset = coulomb_positive + coulomb_negative in every motion");
  EXPECT_THAT(problems[0].help, HasSubstr("remove one of \"offset\", \"coulomb_positive\", \"coulomb_negative\""));
}

TEST(Regressor, AcceptsEveryPairOfPlainTerms) {
  for (auto const* first : effect_choices()) {
    for (auto const* second : effect_choices()) {
      if (first == second || !first->is_plain_term() || !second->is_plain_term()) continue;
      EXPECT_TRUE(problems_of({first->name(), second->name()}).empty());
    }
  }
}

TEST(Regressor, RefusesUnknownRepeatedAndMissingTermsAllAtOnce) {
  auto const problems = problems_of({"viscos", "inertia", "inertia"});
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_THAT(problems[0].what, HasSubstr("\"viscos\""));
  EXPECT_THAT(problems[0].caret_note, HasSubstr("\"viscous\""));
  EXPECT_THAT(problems[1].what, HasSubstr("listed twice"));
  EXPECT_THAT(problems_of({})[0].what, HasSubstr("no terms"));
}

TEST(VelocityDeadband, SilencesDryFrictionOnly) {
  Regressor const regressor({"viscous", "coulomb"}, JointKind::revolute, 0.1);
  auto motion = test::rich_motion(3);
  motion.dq << 0.1, -0.05, 0.11;
  auto const phi = regressor.columns(motion);
  EXPECT_EQ(phi.col(0), motion.dq);
  EXPECT_EQ(phi.col(1), Eigen::Vector3d(0.0, 0.0, 1.0));
}

TEST(VelocityDeadband, OfZeroIsTheSignFunction) {
  Regressor const regressor({"coulomb"}, JointKind::revolute);
  auto motion = test::rich_motion(3);
  motion.dq << 1e-300, 0.0, -1e-300;
  EXPECT_EQ(regressor.columns(motion).col(0), Eigen::Vector3d(1.0, 0.0, -1.0));
}

TEST(ModelOptions, HaveNoTermsUnlessWritten) { EXPECT_THROW(make_regressor({}, {}), Error); }

TEST(ModelOptions, AreReadFromTheModelSection) {
  Section const section{"model",
                        {},
                        {{"joint", std::string("prismatic")},
                         {"terms", std::vector<std::string>{"viscous"}},
                         {"velocity_deadband", 0.01}}};
  ModelOptions options;
  std::vector<Problem> problems;
  ModelOptions::table().apply(section, options, problems);
  EXPECT_TRUE(problems.empty());
  auto const regressor = make_regressor(options, section);
  EXPECT_EQ(regressor.joint(), JointKind::prismatic);
  EXPECT_EQ(regressor.velocity_deadband(), 0.01);
}

}  // namespace regressor_test
}  // namespace torquescope
