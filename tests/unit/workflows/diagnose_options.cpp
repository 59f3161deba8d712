// [diagnose] and which jobs it makes complete: effects by name or all, refusals with suggestions.

#include "engine/experiment/diagnose_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/experiment/experiment_parts.hpp"
#include "support/simulated_job.hpp"

namespace torquescope {
namespace diagnose_options_test {

using ::testing::HasSubstr;
using ::testing::SizeIs;
using Purpose = Experiment::Purpose;

Experiment load(std::string const& more, Purpose purpose) {
  return test::load_job(more + test::joint_model + test::simulated_joint, purpose);
}

std::vector<Problem> problems_of(std::string const& more, Purpose purpose) {
  try {
    load(more, purpose);
  } catch (Error const& error) {
    return error.problems();
  }
  return {};
}

std::vector<std::string> names_of(std::vector<Effect const*> const& effects) {
  std::vector<std::string> names;
  for (Effect const* effect : effects) names.push_back(effect->name());
  return names;
}

TEST(DiagnoseOptions, ADiagnosisNeedsNoEstimatorAndNoSection) {
  Experiment const experiment = load("", Purpose::diagnose);
  DiagnoseOptions const& options = experiment.parts().diagnose;
  EXPECT_EQ(options.effects, std::vector<std::string>{"all"});
  EXPECT_EQ(options.replicates, 200);
  EXPECT_EQ(options.q, 0.05);
  EXPECT_EQ(options.max_effects, 5);
  EXPECT_THAT(experiment.diagnose_line(), HasSubstr("1 joint, 4 parameters; "));
  EXPECT_THAT(experiment.diagnose_line(), HasSubstr(" effects, 200 replicates"));
}

TEST(DiagnoseOptions, ARunStillNeedsAnEstimatorAndSaysWhoCanDoWithoutOne) {
  auto const problems = problems_of("[diagnose]\n", Purpose::identify);
  ASSERT_THAT(problems, SizeIs(1));
  EXPECT_EQ(problems[0].what, "the job has no [[estimator]]");
  EXPECT_THAT(problems[0].help, HasSubstr("torquescope diagnose"));
  EXPECT_THAT(problems_of("[diagnose]\n", Purpose::check), SizeIs(0));
  auto const neither = problems_of("", Purpose::check);
  ASSERT_THAT(neither, SizeIs(1));
  EXPECT_THAT(neither[0].help, HasSubstr("[diagnose]"));
}

// a verdict does not rest on single values
TEST(DiagnoseOptions, WhatNoValueCanBeTrustedForIsARemarkWhereNoValueIsAskedFor) {
  std::string const small = "[model]\nterms = [\"inertia\", \"viscous\", \"coulomb\", \"offset\", \"gravity\"]\n" +
                            test::simulated_joint + "[simulate.reference]\namplitude = 0.1\n";
  auto const told = ::testing::Contains(HasSubstr("offset and gravity_cos correlate"));
  Experiment const diagnosis = test::load_job(small, Purpose::diagnose);
  EXPECT_THAT(diagnosis.warnings(), ::testing::Not(told));
  EXPECT_THAT(diagnosis.remarks(), told);
  Experiment const fit = test::load_job("[[estimator]]\nname = \"ols\"\n" + small, Purpose::identify);
  EXPECT_THAT(fit.warnings(), told);
  EXPECT_THAT(fit.remarks(), ::testing::Not(told));
}

TEST(DiagnoseOptions, AllLeavesOutTheTermsOfTheModelAndWhatTheJointCannotHave) {
  Experiment const experiment = load("", Purpose::diagnose);
  auto const names = names_of(experiment.parts().effects);
  EXPECT_THAT(names, ::testing::Contains("stribeck"));
  EXPECT_THAT(names, ::testing::Contains("encoder_eccentricity"));
  EXPECT_THAT(names, ::testing::Not(::testing::Contains("viscous")));
  std::vector<Problem> problems;
  auto const slide = names_of(chosen_effects({}, JointKind::prismatic, {"viscous"}, {}, problems));
  EXPECT_THAT(slide, ::testing::Not(::testing::Contains("encoder_eccentricity")));
  EXPECT_TRUE(problems.empty());
}

TEST(DiagnoseOptions, AllIsAWordNotAList) {
  EXPECT_EQ(load("[diagnose]\neffects = \"all\"\n", Purpose::diagnose).parts().effects,
            load("", Purpose::diagnose).parts().effects);
}

TEST(DiagnoseOptions, NamedEffectsKeepTheirOrder) {
  Experiment const experiment =
      load("[diagnose]\neffects = [\"presliding\", \"stribeck\"]\ntwins = 60\n", Purpose::diagnose);
  EXPECT_EQ(names_of(experiment.parts().effects), (std::vector<std::string>{"presliding", "stribeck"}));
  EXPECT_EQ(experiment.parts().diagnose.replicates, 60);
}

TEST(DiagnoseOptions, KeysOfEarlierProgramsSayWhatToDo) {
  auto const gone = problems_of("[diagnose]\nreversals = \"mask\"\nnull = \"hac\"\n", Purpose::diagnose);
  ASSERT_THAT(gone, SizeIs(2));
  EXPECT_EQ(gone[0].what, "key \"reversals\" of [diagnose] is gone");
  EXPECT_EQ(gone[0].place.line, 2);
  EXPECT_THAT(gone[0].help, HasSubstr("all samples"));
  EXPECT_THAT(gone[1].help, HasSubstr("[diagnose.levels]"));
}

TEST(DiagnoseOptions, RefusesNamesThatMeanNothingHereWithTheirPlace) {
  auto const unknown = problems_of("[diagnose]\neffects = [\"stribek\"]\n", Purpose::diagnose);
  ASSERT_THAT(unknown, SizeIs(1));
  EXPECT_EQ(unknown[0].what, "unknown effect \"stribek\"");
  EXPECT_EQ(unknown[0].caret_note, "did you mean \"stribeck\"?");
  EXPECT_EQ(unknown[0].place.line, 2);
  EXPECT_THAT(problems_of("[diagnose]\neffects = [\"all\", \"stribeck\"]\n", Purpose::diagnose), SizeIs(1));
  EXPECT_THAT(problems_of("[diagnose]\neffects = [\"stribeck\", \"stribeck\"]\n", Purpose::diagnose), SizeIs(1));
  EXPECT_THAT(problems_of("[diagnose]\neffects = [\"viscous\"]\n", Purpose::diagnose), SizeIs(1));
  EXPECT_THAT(problems_of("[diagnose]\neffects = []\n", Purpose::diagnose), SizeIs(1));
  EXPECT_THAT(problems_of("[diagnose]\ntwins = 19\nq = 0.6\n", Purpose::diagnose), SizeIs(2));
  // told by every command, also where nothing is diagnosed
  EXPECT_THAT(problems_of("[diagnose]\ntwinz = 100\n[[estimator]]\nname = \"ols\"\n", Purpose::identify), SizeIs(1));
}

TEST(DiagnoseOptions, AnAblationIsReadAndWarnedAbout) {
  Experiment const whole = load("[diagnose.levels]\nbeam = 3\n", Purpose::diagnose);
  EXPECT_THAT(whole.parts().levels.changed(), SizeIs(0));
  EXPECT_THAT(whole.warnings(), ::testing::Not(::testing::Contains(HasSubstr("ablation"))));
  Experiment const experiment =
      load("[diagnose]\nq = 0.02\n[diagnose.levels]\nbeam = 1\nsticking_odds = 1.5\n", Purpose::diagnose);
  EXPECT_EQ(experiment.parts().levels.changed(), (std::vector<std::string>{"sticking_odds = 1.5", "beam = 1"}));
  EXPECT_THAT(experiment.warnings(), ::testing::Contains(HasSubstr("an ablation (sticking_odds = 1.5, beam = 1)")));
  bool is_checked = false;
  for (auto const& line : experiment.check(1))
    is_checked |= line.level == CheckLine::Level::warn && line.text.find("ablation") != std::string::npos;
  EXPECT_TRUE(is_checked);
  DecisionNumbers const numbers = decision_numbers(experiment.parts().diagnose, experiment.parts().levels);
  EXPECT_EQ(numbers.alpha, 0.02);
  EXPECT_EQ(numbers.beam, 1);
  EXPECT_EQ(numbers.replicates, 48) << "twins = 200 is an upper bound";
  EXPECT_THAT(problems_of("[diagnose.levels]\nbeams = 1\nbeam = 0\n", Purpose::diagnose), SizeIs(2));
}

}  // namespace diagnose_options_test
}  // namespace torquescope
