// The last look at several names: what explains nothing beside the others goes, and a wrong relative gives way to the
// right one. The joint has a Stribeck curve and weight.

#include "engine/search/backward_selection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "engine/search/joint_refinement.hpp"
#include "unit/twin/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace backward_selection_test {

class BackwardSelection : public testing::Test {
 protected:
  static Recording recording_with_effects() {
    auto joint = clean_joint();
    joint.plan.plant = plant({{"inertia", joint.truth[0]},
                              {"viscous", joint.truth[1]},
                              {"coulomb", joint.truth[2]},
                              {"offset", joint.truth[3]},
                              {"stribeck", 0.4},
                              {"stribeck_speed", 0.3},
                              {"stribeck_exponent", 1.0},
                              {"gravity_sin", 0.3},
                              {"gravity_cos", 0.3}});
    return recorded(simulate_joint(joint.plan, 3));
  }

  // as if the search had accepted these, and had seen all candidates at its first step
  void accept(std::vector<std::string> const& names) {
    ModelStage const first = make_stage(setting, clean_regressor()).value();
    CandidateColumns const columns(*first.pipeline, first.comparison, first.reference(), first.parameters());
    std::vector<Effect const*> candidates;
    for (auto const* name : {"stribeck", "gravity", "end_stop", "asymmetric_viscous"})
      candidates.push_back(find_effect(name));
    selection.first_scan = scan_candidates(columns, candidates, 2);
    selection.first_q.assign(candidates.size(), 0.0);
    selection.first_excess = first.energy.excess;
    std::vector<ShapedEffect> effects;
    for (auto const& name : names)
      for (auto const& scan : selection.first_scan)
        if (scan.effect->name() == name) {
          effects.push_back({scan.effect, scan.shape});
          selection.accepted.push_back({scan.effect, scan, 0.0, scan.gain, scan.gain});
        }
    selection.final =
        std::make_shared<ModelStage const>(refined_stage(setting, first.reference(), std::move(effects)).value());
  }

  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (auto const& one : selection.accepted) found.push_back(one.effect->name());
    std::vector<std::string> in_model;
    for (auto const& one : selection.final->model().effects()) in_model.push_back(one.effect->name());
    EXPECT_EQ(found, in_model);
    return found;
  }

  Recording const recording = recording_with_effects();
  FilterOptions const filter = clean_filter();
  Section const section{};
  StageSetting const setting{recording, clean_regressor(), filter, section, 24, 1, 2};
  SelectionOptions const options{};
  Selection selection;
};

TEST_F(BackwardSelection, KeepsWhatIsRight) {
  accept({"gravity", "stribeck"});
  revise_selection(setting, options, selection);
  EXPECT_EQ(names(), (std::vector<std::string>{"gravity", "stribeck"}));
  EXPECT_TRUE(selection.rejected.empty());
}

TEST_F(BackwardSelection, TakesOutWhatTheOthersExplain) {
  accept({"asymmetric_viscous", "gravity", "stribeck"});
  revise_selection(setting, options, selection);
  EXPECT_EQ(names(), (std::vector<std::string>{"gravity", "stribeck"}));
  ASSERT_EQ(selection.rejected.size(), 1U);
  EXPECT_EQ(selection.rejected.front().effect->name(), "asymmetric_viscous");
}

TEST_F(BackwardSelection, PutsTheRightRelativeInTheWrongOnesPlace) {
  accept({"end_stop", "stribeck"});
  double const before = selection.final->mismatch().squaredNorm();
  revise_selection(setting, options, selection);
  EXPECT_EQ(names(), (std::vector<std::string>{"gravity", "stribeck"}));
  EXPECT_LT(selection.final->mismatch().squaredNorm(), 0.5 * before);
  ASSERT_EQ(selection.rejected.size(), 1U);
  EXPECT_NE(selection.rejected.front().reason.find("gravity"), std::string::npos);
}

}  // namespace backward_selection_test
