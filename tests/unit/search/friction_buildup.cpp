// Friction that builds up after reversals is found where the mask hides it; a sharp sign and a smeared one are not it.

#include "engine/search/friction_buildup.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "unit/twin/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace friction_buildup_test {

class FrictionBuildup : public testing::Test {
 protected:
  // a loop that holds the joint to its reference: how it turns round is then no question of its friction
  static constexpr double stiff_hz = 20.0;

  static Recording recording_of(std::vector<PlantTerm> terms, double bandwidth_hz = stiff_hz) {
    auto joint = clean_joint();
    joint.plan.plant = std::move(terms);
    joint.plan.controller.bandwidth_hz = bandwidth_hz;
    return recorded(simulate_joint(joint.plan, 3));
  }

  // as if the masked search had found nothing
  static Selection nothing_found(StageSetting const& setting, SelectionOptions const& options) {
    Selection selection;
    selection.baseline = selection.final =
        std::make_shared<ModelStage const>(make_stage(setting, clean_regressor()).value());
    CandidateColumns const columns(*selection.final->pipeline, selection.final->comparison,
                                   selection.final->reference(), selection.final->parameters());
    selection.first_scan = scan_candidates(columns, options.candidates, 2);
    selection.first_q.assign(selection.first_scan.size(), 1.0);
    selection.first_cv_gain.assign(selection.first_scan.size(), 0.0);
    selection.first_energy = selection.final->energy;
    return selection;
  }

  Selection look(Recording const& recording) {
    FilterOptions const filter = clean_filter();
    Section const section{};
    StageSetting const setting{recording, clean_regressor(), filter, section, 64, 1, 2};
    SelectionOptions options;
    for (auto const* name : {"presliding", "maxwell_slip", "stribeck", "delay", "gravity"})
      options.candidates.push_back(find_effect(name));
    Selection selection = nothing_found(setting, options);
    found = look_at_reversals(setting, options, selection, {});
    return selection;
  }

  bool found = false;
};

struct BuildupCase {
  double bandwidth_hz, distance;
};

class FrictionBuildupIn : public FrictionBuildup, public testing::WithParamInterface<BuildupCase> {};

INSTANTIATE_TEST_SUITE_P(Loop, FrictionBuildupIn, testing::Values(BuildupCase{20.0, 1e-3}, BuildupCase{10.0, 2e-4}));

TEST_P(FrictionBuildupIn, IsFoundWhereNothingElseShows) {
  // the scalar plant has no memory: a twin with one stands in for the joint
  constexpr double share = 0.9;
  double const distance = GetParam().distance;
  Recording recording = recording_of(clean_joint().plan.plant, GetParam().bandwidth_hz);
  FilterOptions const filter = clean_filter();
  Section const section{};
  StageSetting const setting{recording, clean_regressor(), filter, section, 16, 1, 2};
  ModelStage const clean = make_stage(setting, clean_regressor()).value();
  JointModel const model(clean_regressor(), clean.reference(), {{find_effect("presliding"), {distance}}});
  Eigen::VectorXd parameters(6);
  parameters << clean.parameters(), share, 0.0;
  CleanTwin const joint(model.twin_joint(parameters), clean.twin->loop.loop, clean.twin->loop.track, 1e-4);
  TwinGroup group;
  joint.simulate({17, 0, 0}, 0, group);
  recording.position = group.position[0];
  recording.torque = group.torque[0];

  Selection const selection = look(recording);
  ASSERT_TRUE(found);
  EXPECT_TRUE(selection.keeps_reversals);
  EXPECT_TRUE(selection.is_gate_open);
  ASSERT_EQ(selection.accepted.size(), 1U);
  EXPECT_EQ(selection.accepted.front().effect->name(), "presliding");
  // on rows with reversals the model takes away nearly all that twins without it lack
  EXPECT_LT(selection.final->energy.excess, 0.1 * selection.baseline->energy.excess);
  // share of the Coulomb friction and distance
  EXPECT_NEAR(selection.final->parameters()[4], share, 0.1 * share);
  EXPECT_NEAR(selection.final->model().effects().front().shape.front(), distance, 0.1 * distance);
}

TEST_F(FrictionBuildup, IsNotASharpSign) {
  Recording const recording = recording_of(clean_joint().plan.plant);
  Selection const selection = look(recording);
  EXPECT_FALSE(found);
  EXPECT_FALSE(selection.keeps_reversals);
  EXPECT_FALSE(selection.differs_at_reversals);
  EXPECT_TRUE(selection.accepted.empty());
}

// friction that is weaker near rest, by a law of the speed alone
TEST_F(FrictionBuildup, IsNotASignSmearedOverTheSpeed) {
  Recording const recording = recording_of(plant({{"inertia", 0.036},
                                                  {"viscous", 0.164},
                                                  {"coulomb", 1.3},
                                                  {"offset", -0.125},
                                                  {"stribeck", -1.0},
                                                  {"stribeck_speed", 0.05},
                                                  {"stribeck_exponent", 1.0}}));
  Selection const selection = look(recording);
  EXPECT_FALSE(found);
  // it is none of the two, and no sharp sign either
  EXPECT_TRUE(selection.differs_at_reversals);
}

}  // namespace friction_buildup_test
