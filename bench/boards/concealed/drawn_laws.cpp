// Drawn cases follow from their names alone, tell nothing, and conceal what they say at the size they say.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "concealed/case_writer.hpp"
#include "concealed/decoys.hpp"
#include "concealed/drawable_effects.hpp"
#include "concealed/drawn_case.hpp"
#include "concealed/exact_case.hpp"

namespace concealed {
namespace drawn_laws_test {

// report_case with nothing but the size
double realised_snr(Case const& drawn) {
  LoopRun const noisy = training_run(drawn, drawn.rig, drawn.effects, default_step_s);
  LoopRun const quiet = training_run(drawn, without_noise(drawn.rig), drawn.effects, default_step_s);
  BaselineFit const fit = fit_baseline(quiet.truth, drawn.rig.joint.baseline.has_gravity());
  return effect_size(quiet, noisy, fit.parameters, drawn.rig).snr();
}

void expect_size(std::string const& name) {
  Case const drawn = drawn_case(parse_drawn_name(name));
  EXPECT_NEAR(realised_snr(drawn) / drawn.wanted_snr, 1.0, 0.1) << name;
}

TEST(DrawnNames, AreReadAsTheyAreWritten) {
  for (int tier = 0; tier <= 7; ++tier) {
    for (std::uint64_t i = 1; i <= 40; ++i) {
      std::string const text = listed_name(tier, i).text();
      EXPECT_EQ(parse_drawn_name(text).text(), text);
    }
  }
  for (char const* wrong : {"", "T1", "T8:1", "T0:x", "T1:stribeck:1", "T1:stribeck:0:1", "T1:stribeck+cable:1:1",
                            "T2:stribeck:1:1", "T1:nothing:1:1", "T4:stribeck:1:1", "T1:outside_sloshing:1:1",
                            "T6:late:1:1", "T6:lat:1", "T5:one_speed:2:1", "T7:noise:2:1", "T1:stribeck:1:1:1"}) {
    EXPECT_THROW(parse_drawn_name(wrong), std::invalid_argument) << wrong;
  }
}

TEST(DrawnNames, GoThroughEveryEffectAtEverySizeForFiveSeeds) {
  std::map<std::string, std::set<std::pair<double, std::uint64_t>>> seen;
  std::size_t const n = catalogue_effects().size();
  for (std::uint64_t i = 1; i <= 25 * n; ++i) {
    DrawnName const name = listed_name(1, i);
    seen[name.words.front()].insert({name.size, name.seed});
  }
  EXPECT_EQ(seen.size(), n);
  for (auto const& [effect, sizes] : seen) EXPECT_EQ(sizes.size(), 25u) << effect;
}

TEST(DrawnNames, OfAnotherSuiteHaveOtherSeedsAndTheSameEffectsAndSizes) {
  std::set<std::string> seen;
  for (int tier = 0; tier <= 7; ++tier) {
    for (std::uint64_t i = 1; i <= 200; ++i) {
      for (std::uint64_t suite : {0u, 1u, 2u}) {
        DrawnName const name = listed_name(tier, i, suite);
        EXPECT_EQ(name.seed / seeds_per_suite, suite);
        EXPECT_EQ(name.size, listed_name(tier, i).size);
        EXPECT_EQ(parse_drawn_name(name.text()).stream(), name.stream());
        seen.insert(name.text());
      }
      if (tier == 1) {
        EXPECT_EQ(listed_name(tier, i, 1).words, listed_name(tier, i).words);
      }
    }
  }
  EXPECT_EQ(seen.size(), 8u * 200u * 3u);
}

TEST(DrawnNames, ConcealSetsOfDifferentFamilies) {
  for (int tier : {2, 3}) {
    std::set<std::vector<std::string>> sets;
    for (std::uint64_t i = 1; i <= 100; ++i) {
      auto const words = listed_name(tier, i).words;
      EXPECT_EQ(std::set<std::string>(words.begin(), words.end()).size(), static_cast<std::size_t>(tier));
      sets.insert(words);
    }
    EXPECT_GT(sets.size(), 80u);
  }
}

TEST(DrawnNames, HideBehindTheirFolders) {
  std::set<std::string> folders;
  for (int tier = 0; tier <= 7; ++tier) {
    for (std::uint64_t i = 1; i <= 200; ++i) {
      std::string const folder = listed_name(tier, i).folder();
      EXPECT_EQ(folder.size(), 12u);
      EXPECT_EQ(folder.find_first_not_of("0123456789abcdef"), std::string::npos);
      folders.insert(folder);
    }
  }
  EXPECT_EQ(folders.size(), 1600u);
}

TEST(DrawnEffects, UseOtherFormsThanTheCatalogueInMoreThanAThird) {
  double others = 0.0;
  std::set<std::string> names;
  for (auto const& effect : catalogue_effects()) {
    Random random(1, "form");
    JointDesign const joint = joint_named(effect.joints.front());
    ConcealedEffect const made = effect.draw(random, joint)(effect.usual)(joint);
    EXPECT_EQ(made.name, effect.name);
    EXPECT_LE(effect.usual, effect.largest);
    others += made.catalogue_form ? 0.0 : 1.0;
    names.insert(effect.name);
  }
  EXPECT_EQ(names.size(), catalogue_effects().size());
  EXPECT_GT(others, static_cast<double>(names.size()) / 3.0);
}

TEST(DrawnCases, SameNameSameBytesAndNoWordOfWhatIsConcealed) {
  auto const folder = std::filesystem::path(testing::TempDir()) / "drawn_bytes";
  DrawnName const name = parse_drawn_name("T1:asymmetric_viscous:2:3");
  Case one = drawn_case(name), two = drawn_case(name);
  EXPECT_EQ(one.seed, two.seed);
  EXPECT_EQ(one.effects.front().parameters.front().value, two.effects.front().parameters.front().value);
  for (Case* brief : {&one, &two}) brief->train_s = brief->validate_s = 6.0;
  EXPECT_EQ(write_case(one, report_case(one), folder / "one"), write_case(two, report_case(two), folder / "two"));
  std::filesystem::remove_all(folder);
  // the job is the same for every case of this kind of joint, but for the name
  Case const clean = drawn_case(parse_drawn_name("T0:1"));
  Case named = clean;
  named.rig.joint = one.rig.joint;
  std::string job = job_text(named);
  job.replace(job.find(clean.name), clean.name.size(), one.name);
  EXPECT_EQ(job, job_text(one));
}

// a load that rattles on a staircase: no step is fine enough for it
TEST(DrawnCases, AreDrawnAnewWhereNoStepIsFineEnough) {
  DrawnName const name = parse_drawn_name("T1:backlash:2:1300005");
  auto const [made, report] = exact_case(name);
  EXPECT_GT(made.plant_draws, 1);
  EXPECT_LE(made.plant_draws, most_plant_draws);
  EXPECT_TRUE(report.step_error.is_exact());
  EXPECT_NEAR(report.together.snr() / made.wanted_snr, 1.0, 0.1);
  // name and folder stay, everything random is another, and the truth says so
  EXPECT_EQ(made.drawn, name.text());
  EXPECT_EQ(made.name, name.folder());
  EXPECT_EQ(made.seed, name.stream(made.plant_draws - 1));
  EXPECT_NE(made.seed, name.stream());
  EXPECT_NE(truth_text(made, report).find("\"plant_draws\": " + std::to_string(made.plant_draws)), std::string::npos);
}

TEST(DrawnCases, ThatAreExactAtOnceStayWithTheFirstDraw) {
  DrawnName const name = parse_drawn_name("T0:3");
  auto const [made, report] = exact_case(name);
  EXPECT_EQ(made.plant_draws, 1);
  EXPECT_EQ(made.seed, name.stream());
  EXPECT_EQ(made.seed, drawn_case(name).seed);
  EXPECT_EQ(truth_text(made, report).find("plant_draws"), std::string::npos);
}

TEST(DrawnCases, SayWhatIsExpectedOfThem) {
  EXPECT_EQ(drawn_case(parse_drawn_name("T0:5")).expected_verdict(), "none");
  EXPECT_EQ(drawn_case(parse_drawn_name("T6:hold:5")).expected_verdict(), "measurement");
  EXPECT_EQ(drawn_case(parse_drawn_name("T7:gains:5")).expected_verdict(), "none");
  Case const weak = drawn_case(parse_drawn_name("T5:narrow+spring:2:1"));
  EXPECT_EQ(weak.expected_verdict(), "insufficient");
  EXPECT_EQ(weak.train, Recipe::narrow);
  // the weak motion shows less of it than the rich one it was sized on
  EXPECT_LT(realised_snr(weak), 0.5 * weak.wanted_snr);
}

TEST(DrawnCases, SpreadOverJointsLoopsNoisesAndMotions) {
  std::set<std::string> joints, controllers, noises, motions;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    Case const clean = drawn_case(listed_name(0, seed));
    joints.insert(clean.rig.joint.name);
    controllers.insert(clean.rig.controller.name);
    noises.insert(clean.rig.noise.name);
    motions.insert(to_text(clean.train));
  }
  EXPECT_EQ(joints.size(), 6u);
  EXPECT_EQ(controllers.size(), 10u);
  EXPECT_EQ(noises.size(), 3u);
  EXPECT_EQ(motions.size(), 6u);
}

// one law of the joint, one with memory, one of the instruments; all of them with
//   drawn_laws --gtest_also_run_disabled_tests --gtest_filter='*EveryEffect*'    (three minutes)
TEST(DrawnCases, HaveTheSizeTheySay) {
  for (char const* name : {"T1:stribeck:1:1", "T1:joint_elasticity:1:1", "T1:delay:1:1"}) expect_size(name);
}

TEST(DrawnCases, DISABLED_EveryEffectHasTheSizeItSays) {
  for (auto const& effect : catalogue_effects()) expect_size("T1:" + effect.name + ":1:2");
  for (auto const& effect : outside_effects()) expect_size("T4:" + effect.name + ":1:2");
}

}  // namespace drawn_laws_test
}  // namespace concealed
