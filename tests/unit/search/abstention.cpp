// When names may stand: what a model leaves is held against smooth functions of anything. The mismatch is planted in
// the rows of one real comparison, so that its size and its axis are known.

#include "engine/search/abstention.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "engine/twin/mismatch_energy.hpp"
#include "unit/twin/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace abstention_test {

class Abstention : public testing::Test {
 protected:
  explicit Abstention(double duration_s = 4.0) : recording(clean_recording(duration_s)) {}

  static Recording clean_recording(double duration_s) {
    auto joint = clean_joint();
    joint.plan.simulation.duration_s = duration_s;
    joint.plan.controller.kind = "pid";
    return recorded(simulate_joint(joint.plan, 3));
  }

  // one effect in the model, whatever it takes of a joint that has none of it
  void name(ShapedEffect effect) {
    stage = make_stage(setting, JointModel(clean_regressor(), stage.reference(), {std::move(effect)})).value();
  }

  // what is left, in shares of the torque's rms
  void leave(double size, Eigen::VectorXd wave) {
    auto& rows = stage.comparison.rows;
    // only what the model's columns cannot take
    CandidateColumns const columns(*stage.pipeline, stage.comparison, stage.reference(), stage.parameters());
    for (int pass = 0; pass < 2; ++pass) wave -= columns.nuisance() * (columns.nuisance().transpose() * wave).eval();
    rows.residual = rows.twin_mean + wave * (size * rows.torque.norm() / wave.norm());
    rows.plain_residual.resize(0);  // rows that weigh alike are the torque itself
    rows.plain_twins.resize(0, 0);
    stage.energy = mismatch_energy(rows);
  }

  // without effects, and with that much missing in the torque itself
  std::shared_ptr<ModelStage const> began_with(double energy) const {
    auto first = std::make_shared<ModelStage>(make_stage(setting, clean_regressor()).value());
    auto& rows = first->comparison.rows;
    rows.plain_residual.resize(0);
    rows.plain_twins.resize(0, 0);
    Eigen::VectorXd const wave = (2.5 * rows.q.array()).cos();
    rows.residual = rows.twin_mean + wave * (std::sqrt(std::max(0.0, energy)) / wave.norm());
    return first;
  }

  Eigen::VectorXd of_position() const { return (2.5 * stage.comparison.rows.q.array()).cos(); }
  Eigen::VectorXd of_time() const { return (2.5 * stage.comparison.rows.time_s.array()).sin(); }
  Eigen::VectorXd of_velocity() const {
    auto const& dq = stage.comparison.rows.dq;
    return (dq.array() * (3.0 / dq.cwiseAbs().maxCoeff())).sin();
  }

  // a search that began with so many times the energy that is left now
  Selection selection_of(double first_over_left, bool is_any_accepted) const {
    Selection selection;
    selection.is_gate_open = true;
    selection.first_excess = first_over_left * std::abs(stage.energy.excess);
    selection.baseline = began_with(selection.first_excess + stage.energy.noise);
    if (is_any_accepted) selection.accepted.push_back({find_effect("stribeck"), {}, 0.0, 1.0, 1.0});
    return selection;
  }

  Recording const recording;
  FilterOptions const filter = clean_filter();
  Section const section{};
  StageSetting const setting{recording, clean_regressor(), filter, section, 24, 1, 1};
  ModelStage stage = make_stage(setting, clean_regressor()).value();
};

TEST_F(Abstention, SaysNothingWhenNothingWasMissing) {
  Selection selection = selection_of(1.0, false);
  selection.is_gate_open = false;
  Remainder const found = judge_remainder(selection, stage);
  EXPECT_FALSE(found.is_unexplained);
  EXPECT_FALSE(found.is_significant);
  EXPECT_EQ(found.share, 0.0);
  EXPECT_TRUE(found.axes.empty());
}

TEST_F(Abstention, WithoutAnyNameWhatIsMissingIsUnexplained) {
  leave(0.1, of_position());
  EXPECT_TRUE(judge_remainder(selection_of(1.0, false), stage).is_unexplained);
}

TEST_F(Abstention, NamesStandWhenNoiseIsAllTheyLeave) {
  // the clean recording itself is what a complete model leaves
  ASSERT_LT(stage.energy.z, 5.0);
  Remainder const found = judge_remainder(selection_of(50.0, true), stage);
  EXPECT_FALSE(found.is_significant);
  EXPECT_FALSE(found.is_unexplained);
  EXPECT_TRUE(found.axes.empty());
}

TEST_F(Abstention, NamesStandWhenTheyLeaveLittleOfTheWhole) {
  leave(0.1, of_position());
  ASSERT_GT(stage.energy.z, 5.0);
  Remainder const found = judge_remainder(selection_of(50.0, true), stage);  // 2 %
  EXPECT_NEAR(found.share, 0.02, 1e-12);
  EXPECT_FALSE(found.is_significant);
  EXPECT_FALSE(found.is_unexplained);
}

TEST_F(Abstention, NamesFallWhenMostOfTheRestIsASmoothFunctionOfAnotherAxis) {
  // a tenth is left: nine tenths have a name, but the rest has a shape that the name has no axis for
  for (bool const is_of_position : {true, false}) {
    leave(0.1, is_of_position ? of_position() : of_time());
    Remainder const found = judge_remainder(selection_of(10.0, true), stage);
    EXPECT_NEAR(found.share, 0.1, 1e-12);
    EXPECT_TRUE(found.is_significant);
    EXPECT_TRUE(found.is_unexplained);
    ASSERT_FALSE(found.axes.empty());
    EXPECT_TRUE(std::is_sorted(found.axes.begin(), found.axes.end(),
                               [](auto const& a, auto const& b) { return a.share > b.share; }));
    auto const own = std::find_if(found.axes.begin(), found.axes.end(), [&](auto const& axis) {
      return axis.name == (is_of_position ? "position" : "time");
    });
    ASSERT_NE(own, found.axes.end());
    EXPECT_GT(own->share, 0.8) << own->name;
    EXPECT_LT(own->share, 1.1) << own->name;
  }
}

TEST_F(Abstention, NamesStandWhenTheRestLiesOnTheirOwnAxis) {
  // a right name whose form is a little wrong
  name({find_effect("stribeck"), {0.2, 1.0}});
  leave(0.1, of_velocity());
  Remainder const found = judge_remainder(selection_of(10.0, true), stage);
  EXPECT_TRUE(found.is_significant);
  ASSERT_FALSE(found.axes.empty());
  EXPECT_GT(found.axes.front().share, 0.5);
  EXPECT_FALSE(found.is_unexplained);
}

TEST_F(Abstention, NamesFallWhenTooLittleIsNamedAndTheRestHasStructure) {
  // on the name's own axis, so that the share alone decides
  name({find_effect("stribeck"), {0.2, 1.0}});
  leave(0.1, of_velocity());
  EXPECT_FALSE(judge_remainder(selection_of(3.1, true), stage).is_unexplained);
  Remainder const found = judge_remainder(selection_of(2.9, true), stage);
  EXPECT_NEAR(found.share, 1.0 / 2.9, 1e-12);
  EXPECT_TRUE(found.is_unexplained);
}

TEST_F(Abstention, NamesFallWhenTheyExplainLessThanHalfWhateverTheRestLooksLike) {
  // a function of nothing: what a law with a memory leaves
  Eigen::Index const n = stage.comparison.rows.size();
  leave(0.1,
        Eigen::VectorXd::NullaryExpr(n, [](Eigen::Index i) { return std::sin(0.37 * static_cast<double>(i * i)); }));
  ASSERT_GT(stage.energy.z, 5.0);
  EXPECT_FALSE(judge_remainder(selection_of(2.1, true), stage).is_unexplained);
  Remainder const found = judge_remainder(selection_of(1.9, true), stage);
  EXPECT_TRUE(found.is_most_left);
  EXPECT_TRUE(found.is_unexplained);
}

TEST_F(Abstention, NamesStandWhenTheyExplainTheTorqueItself) {
  // weighed rows make little of friction that wanders: what is left of them is most, of the torque itself it is a crumb
  Eigen::Index const n = stage.comparison.rows.size();
  leave(0.1,
        Eigen::VectorXd::NullaryExpr(n, [](Eigen::Index i) { return std::sin(0.37 * static_cast<double>(i * i)); }));
  Selection selection = selection_of(1.9, true);
  ASSERT_TRUE(judge_remainder(selection, stage).is_most_left);
  selection.baseline = began_with(20.0 * selection.first_excess);
  EXPECT_FALSE(judge_remainder(selection, stage).is_most_left);
}

TEST_F(Abstention, NamesStandWhenAllButTheyIsWithinChance) {
  ASSERT_LT(stage.energy.z, 3.0);
  EXPECT_FALSE(judge_remainder(selection_of(1.5, true), stage).is_unexplained);
}

// long enough that time and the torque so far do not know the position
class LongAbstention : public Abstention {
 protected:
  LongAbstention() : Abstention(20.0) {}
};

// the axis "position and velocity" holds every function of position alone, so an effect of position owns it as well
TEST_F(LongAbstention, NamesStandWhenTheRestLiesOnTheirOwnAxisOfPosition) {
  name({find_effect("cogging"), {9.0}});
  leave(0.1, of_position());
  Remainder const found = judge_remainder(selection_of(10.0, true), stage);
  EXPECT_TRUE(found.is_significant);
  ASSERT_FALSE(found.axes.empty());
  EXPECT_EQ(found.axes.front().name, "position");
  EXPECT_FALSE(found.is_unexplained);
}

MapAxis axis_with(char const* name, std::vector<MismatchRegion> regions) {
  MapAxis axis{name, "s"};
  axis.regions = std::move(regions);
  return axis;
}

TEST(LargestParts, BeginWithTheShareThatIsMostSurprisingForItsTime) {
  auto const parts = largest_parts(
      {axis_with("velocity", {{{"velocity", -1.0, 1.0, "rad/s"}, 0.95, 0.99, 0.9}}),
       axis_with("time", {{{"time", 3.0, 7.0, "s"}, 0.13, 0.44, 0.3}, {{"time", 8.0, 9.0, "s"}, 0.2, 0.1, 0.5}})});
  // less than its share of the time is no place to look
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].where.axis, "time");
  EXPECT_EQ(parts[0].energy_share, 0.44);
  EXPECT_EQ(parts[1].where.axis, "velocity");
}

TEST(LargestParts, OfASpectrumTellTheStretchThatIsNeitherWideNorTheTorquesOwn) {
  MapAxis spectrum{"frequency", "Hz", true};
  for (int i = 0; i < 20; ++i) {
    MapCell cell{static_cast<double>(i), static_cast<double>(i + 1), 10, i == 12 ? 3.0 : 1.0, 0.1};
    cell.torque_share = 0.05;
    spectrum.cells.push_back(cell);
  }
  spectrum.regions = {{{"frequency", 0.0, 20.0, "Hz"}, unknown, 1.0, 0.99}};
  auto const parts = largest_parts({spectrum});
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].where.from, 12.0);
  EXPECT_EQ(parts[0].where.to, 13.0);
  EXPECT_NEAR(parts[0].energy_share, 9.0 / 28.0, 1e-12);
  // where the torque is, any law of the motion is
  for (auto& cell : spectrum.cells) cell.torque_share = cell.from == 12.0 ? 0.9 : 0.1 / 19.0;
  for (auto const& part : largest_parts({spectrum})) EXPECT_NE(part.where.to - part.where.from, 1.0);
}

}  // namespace abstention_test
