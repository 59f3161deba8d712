// The search for a missing effect spreads over threads without a trace in its numbers: the scan of the grids and the
// refinement of a shape. Also what the thread sanitizer sees of both.

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "engine/search/form_freedom.hpp"
#include "engine/search/model_stage.hpp"
#include "engine/search/shape_refinement.hpp"
#include "unit/twin/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace candidate_search_test {

// a joint with Stribeck friction, compared with twins that have none
class CandidateSearch : public testing::Test {
 protected:
  static Recording stribeck_recording() {
    auto joint = clean_joint();
    joint.plan.simulation.duration_s = 4.0;
    joint.plan.plant = plant({{"inertia", 0.036},
                              {"viscous", 0.164},
                              {"coulomb", 1.3},
                              {"offset", -0.125},
                              {"stribeck", 0.5},
                              {"stribeck_speed", 0.1},
                              {"stribeck_exponent", 1.0}});
    return recorded(simulate_joint(joint.plan, 3));
  }

  Recording const recording = stribeck_recording();
  FilterOptions const filter = clean_filter();
  Section const section{};
  ModelStage const stage =
      make_stage({recording, clean_regressor(), filter, section, 24, 1, 2}, clean_regressor()).value();
  CandidateColumns const columns{*stage.pipeline, stage.comparison, stage.reference(), stage.parameters()};
  std::vector<Effect const*> const effects{find_effect("stribeck"), find_effect("power_law_viscous"),
                                           find_effect("cogging")};
};

TEST_F(CandidateSearch, ScansWithTheSameBitsForAnyNumberOfThreads) {
  auto const alone = scan_candidates(columns, effects, 1);
  ASSERT_EQ(alone.size(), effects.size());
  EXPECT_GT(alone[0].gain, 0.0);
  for (int threads : {2, 3}) {
    auto const together = scan_candidates(columns, effects, threads);
    ASSERT_EQ(together.size(), alone.size());
    for (std::size_t i = 0; i < alone.size(); ++i) {
      EXPECT_EQ(together[i].effect, alone[i].effect);
      EXPECT_EQ(together[i].best_point, alone[i].best_point);
      EXPECT_EQ(together[i].z, alone[i].z);
      EXPECT_EQ(together[i].p, alone[i].p);
      EXPECT_EQ(together[i].gain, alone[i].gain);
      EXPECT_EQ(together[i].parameters, alone[i].parameters);
    }
  }
}

TEST_F(CandidateSearch, RefinesAShapeWithTheSameBitsForAnyNumberOfThreads) {
  auto const scan = scan_candidates(columns, {effects.front()}, 2).front();
  auto const search = shape_search("de", 1);
  auto const alone = refine_shape(columns, scan, stage.mismatch(), search, 1);
  EXPECT_GE(alone.gain, scan.gain);
  for (int threads : {2, 3}) {
    auto const together = refine_shape(columns, scan, stage.mismatch(), search, threads);
    EXPECT_EQ(together.shape, alone.shape);
    EXPECT_EQ(together.parameters, alone.parameters);
    EXPECT_EQ(together.gain, alone.gain);
    EXPECT_EQ(together.evaluations, alone.evaluations);
  }
}

// what diagnose.shape_optimiser promises
TEST_F(CandidateSearch, RefinesAShapeWithEveryOptimiserOfTheRegistry) {
  auto const scan = scan_candidates(columns, {effects.front()}, 2).front();
  for (auto const& choice : optimiser_choices()) {
    auto const refined = refine_shape(columns, scan, stage.mismatch(), shape_search(choice.name, 1), 2);
    EXPECT_GT(refined.gain, scan.gain) << choice.name;
    ASSERT_FALSE(refined.improvements.empty());
    EXPECT_EQ(refined.improvements.front().evaluations, 1);
    EXPECT_LE(refined.improvements.back().evaluations, refined.evaluations);
    for (std::size_t i = 1; i < refined.improvements.size(); ++i)
      EXPECT_GT(refined.improvements[i].gain, refined.improvements[i - 1].gain);
    // the gain that is reported has had chance taken off
    EXPECT_LT(refined.gain, refined.improvements.back().gain);
  }
}

// a law of the speed along the motion, small beside what was named: another form of a named law of the speed, none of
// the position
TEST_F(CandidateSearch, TellsWhatAnotherFormOfANamedLawWouldExplain) {
  auto const scan = scan_candidates(columns, {effects.front()}, 2).front();
  auto const refined = refine_shape(columns, scan, stage.mismatch(), shape_search("de", 1), 2);
  auto const is_form_of_named = [&](char const* named, double times) {
    return is_form_of({find_effect(named), {24.0}}, times * refined.gain, refined, stage, columns);
  };
  EXPECT_TRUE(is_form_of_named("power_law_viscous", 20.0));
  EXPECT_FALSE(is_form_of_named("power_law_viscous", 5.0)) << "too much for a form";
  EXPECT_FALSE(is_form_of_named("gravity", 20.0)) << "another axis";
  EXPECT_FALSE(is_form_of_named("cogging", 20.0)) << "a wave has no form beside its orders";
}

// whatever the order's law is, the part of the machine is the same
TEST_F(CandidateSearch, TellsAWaveOfTheSameOrderAsAnotherFormOfTheNamedOne) {
  RefinedEffect ripple;
  ripple.effect = find_effect("torque_ripple");
  ripple.gain = 1.0;
  double const wave = bound_value({1.0, RelativeTo::lowest_order}, columns.scales());
  auto const is_form_of_cogging = [&](double order, double named_gain) {
    ripple.shape = {order};
    return is_form_of({find_effect("cogging"), {24.0 * wave}}, named_gain, ripple, stage, columns);
  };
  EXPECT_TRUE(is_form_of_cogging(24.4 * wave, 5.0));
  EXPECT_TRUE(is_form_of_cogging(48.2 * wave, 5.0)) << "its second wave";
  EXPECT_FALSE(is_form_of_cogging(24.4 * wave, 3.0)) << "too much for a form";
  EXPECT_FALSE(is_form_of_cogging(25.5 * wave, 5.0)) << "an order of its own";
  EXPECT_FALSE(is_form_of({find_effect("torque_ripple"), {24.0 * wave}}, 5.0, ripple, stage, columns))
      << "of the same kind: waves of one effect stand each for itself";
}

// a second wave of one name is judged by what it explained itself, not by what the first one did
TEST_F(CandidateSearch, HoldsEachWaveOfOneNameAgainstItsOwnGain) {
  double const wave = bound_value({1.0, RelativeTo::lowest_order}, columns.scales());
  StageSetting setting{recording, clean_regressor(), filter, section, 16, 1, 2};
  Effect const* cogging = find_effect("cogging");
  ModelStage const two = make_stage(setting, JointModel(clean_regressor(), stage.reference(),
                                                        {{cogging, {24.0 * wave}}, {cogging, {60.0 * wave}}}))
                             .value();
  CandidateColumns const beside{*two.pipeline, two.comparison, two.reference(), two.parameters()};
  RefinedEffect ripple;
  ripple.effect = find_effect("torque_ripple");
  ripple.gain = 1.0;
  ripple.shape = {60.0 * wave};
  std::vector<double> const gains{20.0, 2.0};
  EXPECT_FALSE(form_of_named(gains, ripple, two, beside).has_value()) << "half of what its own order explained";
  ripple.shape = {24.0 * wave};
  EXPECT_EQ(form_of_named(gains, ripple, two, beside), std::optional<std::size_t>(0));
}

}  // namespace candidate_search_test
