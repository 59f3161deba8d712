// A line of the search can be copied before a round and go another way from there; the other way wins only when it
// leaves less.

#include "engine/search/rival_lines.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "unit/twin/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace rival_lines_test {

// friction that rises with the speed as a power of it: on this motion a drag of squares and cubes explains it nearly as
// well
class RivalLines : public testing::Test {
 protected:
  static Recording power_law_recording() {
    auto joint = clean_joint();
    joint.plan.simulation.duration_s = 4.0;
    joint.plan.plant = plant({{"inertia", 0.036},
                              {"viscous", 0.164},
                              {"coulomb", 1.3},
                              {"offset", -0.125},
                              {"power_law_viscous", 0.05},
                              {"power_law_exponent", 1.8}});
    return recorded(simulate_joint(joint.plan, 3));
  }

  static std::vector<std::string> names(Selection const& selection) {
    std::vector<std::string> found;
    for (auto const& one : selection.accepted) found.push_back(one.effect->name());
    return found;
  }

  Recording const recording = power_law_recording();
  FilterOptions const filter = clean_filter();
  Section const section{};
  StageSetting const setting{recording, clean_regressor(), filter, section, 64, 1, 2};
  SelectionOptions const options{{find_effect("power_law_viscous"), find_effect("speed_drag"), find_effect("gravity")}};
  StageSink const silent{};
};

using Names = std::vector<std::string>;

TEST_F(RivalLines, ACopyTakesWhatTheLineNearlyTook) {
  EffectSearch line(setting, options, silent);
  Round const round = line.next_round();
  ASSERT_TRUE(round.is_taken);
  ASSERT_EQ(round.nearly_taken.size(), 1U);
  Names const taken = names(line.selection());
  std::string const rival = round.nearly_taken[0].refined.effect->name();
  ASSERT_EQ(taken.size(), 1U);
  EXPECT_NE(taken[0], rival);

  EffectSearch other = *round.before;
  EXPECT_TRUE(other.selection().accepted.empty());
  EXPECT_TRUE(other.selection().is_gate_open) << "what the round had searched is known";
  ASSERT_TRUE(other.take(round.nearly_taken[0]));
  EXPECT_EQ(names(other.selection()), Names{rival});
  EXPECT_EQ(names(line.selection()), taken) << "the first line does not notice";
  EXPECT_EQ(other.selection().baseline, line.selection().baseline);
  EXPECT_LT(other.left_share(), 0.2);
}

TEST_F(RivalLines, TheFirstLineStaysWhereTheOtherLeavesAsMuch) {
  EffectSearch const begin(setting, options, silent);
  EffectSearch alone = begin;
  while (alone.next_round().is_taken) {
  }
  EffectSearch const best = best_line(begin);
  EXPECT_EQ(names(best.selection()), names(alone.selection()));
  EXPECT_EQ(best.left_share(), alone.left_share());
}

}  // namespace rival_lines_test
