// Intervals hold the truth of a right law, grow where a law leaves something beyond noise, and end where a parameter
// does.

#include "engine/infer/search/parameter_intervals.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/infer/search/law_discrepancy.hpp"
#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace parameter_intervals_test {

constexpr double drag = 0.05, power = 1.8;

// friction that rises with a power of the speed
class ParameterIntervals : public testing::Test {
 protected:
  static Recording power_law_recording() {
    auto joint = clean_joint();
    joint.plan.plant = plant({{"inertia", 0.036},
                              {"viscous", 0.164},
                              {"coulomb", 1.3},
                              {"offset", -0.125},
                              {"power_law_viscous", drag},
                              {"power_law_exponent", power}});
    return recorded(simulate_joint(joint.plan, 5));
  }

  ModelStage stage_with(std::string const& effect, std::vector<double> shape) const {
    std::vector<ShapedEffect> effects{{find_effect(effect), std::move(shape)}};
    return make_stage(setting, JointModel(clean_regressor(), plain.reference(), std::move(effects))).value();
  }

  Recording const recording = power_law_recording();
  FilterOptions const filter = clean_filter();
  Section const section{};
  StageSetting const setting{recording, clean_regressor(), filter, section, 32, 1, 2};
  ModelStage const plain = make_stage(setting, clean_regressor()).value();
};

double width(ParameterEstimate const& one) { return one.upper - one.lower; }

void expect_within(ParameterEstimate const& one, double truth) {
  EXPECT_LE(one.lower, truth) << one.name;
  EXPECT_GE(one.upper, truth) << one.name;
}

TEST_F(ParameterIntervals, HoldTheTruthOfTheRightLaw) {
  ModelEstimate const found = estimate_parameters(stage_with("power_law_viscous", {power}));
  ASSERT_EQ(found.effects.size(), 1U);
  ASSERT_EQ(found.effects[0].size(), 2U);
  expect_within(found.effects[0][0], drag);
  expect_within(found.effects[0][1], power);
  EXPECT_LT(width(found.effects[0][1]), 1.0) << "they say something";
  expect_within(found.baseline[0], 0.036);
}

TEST_F(ParameterIntervals, AreWiderBesideALawThatLeavesSomething) {
  ModelStage const right = stage_with("power_law_viscous", {power}), wrong = stage_with("asymmetric_viscous", {});
  ASSERT_EQ(sure_excess(right.energy), 0.0);
  ASSERT_GT(sure_excess(wrong.energy), 0.0);
  ModelEstimate const by_right = estimate_parameters(right), by_wrong = estimate_parameters(wrong);
  EXPECT_GT(width(by_wrong.baseline[0]), 1.5 * width(by_right.baseline[0]));
  expect_within(by_wrong.baseline[0], 0.036);
}

TEST_F(ParameterIntervals, EndAtNoneWhereNothingCanBeLess) {
  ModelStage const stage = stage_with("breakaway_dwell", {0.5, 0.01, 0.5});
  ModelEstimate const found = estimate_parameters(stage);
  for (auto const& one : found.effects.at(0)) {
    EXPECT_GE(one.lower, 0.0) << one.name;
    EXPECT_GE(one.upper, one.value) << one.name;
  }
}

}  // namespace parameter_intervals_test
