// A name among several that unseen recordings speak against goes, the others stay. The joint has a Stribeck curve; the
// teeth that a second name speaks of are in the training recording only, or in both.

#include "engine/unseen/unseen_selection.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/search/joint_refinement.hpp"
#include "engine/unseen/unseen_floor.hpp"
#include "unit/twin/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace unseen_selection_test {

class UnseenSelection : public testing::Test {
 protected:
  static Recording with_teeth(double size, std::uint32_t index) {
    auto joint = clean_joint();
    joint.plan.plant = plant({{"inertia", joint.truth[0]},
                              {"viscous", joint.truth[1]},
                              {"coulomb", joint.truth[2]},
                              {"offset", joint.truth[3]},
                              {"stribeck", 0.5},
                              {"stribeck_speed", 0.3},
                              {"stribeck_exponent", 1.0},
                              {"cogging_sin", size},
                              {"cogging_cos", 0.0},
                              {"cogging_order", order}});
    return recorded(simulate_joint(joint.plan, index));
  }

  // as if the search had named both
  void SetUp() override {
    auto first = make_stage(setting, clean_regressor()).value();
    selection.is_gate_open = true;
    selection.first_excess =
        100.0 * first.energy.excess;  // as if far more had been missing: the teeth alone are a crumb
    std::vector<ShapedEffect> const effects{{find_effect("stribeck"), {0.3, 1.0}}, {find_effect("cogging"), {order}}};
    for (auto const& one : effects) {
      AcceptedEffect accepted;
      accepted.effect = one.effect;
      selection.accepted.push_back(accepted);
    }
    selection.final = std::make_shared<ModelStage const>(refined_stage(setting, first.reference(), effects).value());
    selection.baseline = std::make_shared<ModelStage const>(std::move(first));
  }

  std::vector<std::string> names_with(Recording const& unseen) {
    Remainder remainder = judge_remainder(selection, *selection.final);
    EXPECT_FALSE(remainder.is_unexplained);
    drop_spoilers(setting, std::span(&unseen, 1), selection, remainder);
    std::vector<std::string> names;
    for (auto const& one : selection.final->model().effects()) names.push_back(one.effect->name());
    EXPECT_EQ(names.size(), selection.accepted.size());
    return names;
  }

  static constexpr double order = 9.0, size = 0.1;
  Recording const recording = with_teeth(size, 1);
  FilterOptions const filter = clean_filter();
  Section const section{};
  StageSetting const setting{recording, clean_regressor(), filter, section, 64, 1, 2};
  Selection selection{};
};

TEST_F(UnseenSelection, DropsTheNameThatSpoilsThePrediction) {
  EXPECT_EQ(names_with(with_teeth(0.0, 2)), std::vector<std::string>{"stribeck"});
  ASSERT_EQ(selection.rejected.size(), 1u);
  EXPECT_EQ(selection.rejected.front().effect->name(), "cogging");
}

TEST_F(UnseenSelection, KeepsWhatHoldsThereToo) {
  EXPECT_EQ(names_with(with_teeth(size, 2)), (std::vector<std::string>{"stribeck", "cogging"}));
}

// all of a law is there in twins that have it: less is a reason to drop a name
TEST_F(UnseenSelection, AsksTwinsHowMuchOfALawIsFoundWhereItIs) {
  Recording const unseen = with_teeth(0.0, 2);
  auto const twins = twins_without(unseen, setting, *selection.final, 1);
  ASSERT_EQ(twins.size(), unseen_twins);
  for (auto const& twin : twins) EXPECT_NEAR(twin.share(), 1.0, 0.3);
  auto const found = predict_unseen(unseen, setting, *selection.baseline, *selection.final).by_effect[1];
  EXPECT_LT(found.share(), least_by_chance(twins));
}

}  // namespace unseen_selection_test
