// The search on simulated joints: nothing on a clean one, the law that is there, and never a law of a clock beside an
// adequate model.

#include "engine/infer/moving_rows/stepwise.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/infer/moving_rows/confidence_set.hpp"
#include "engine/infer/moving_rows/kept_model.hpp"
#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace stepwise_test {

class Stepwise : public testing::Test {
 protected:
  // with a law added to the torque channel's record along the measured motion, which no controller answers
  static Recording recording_with(std::string const& name, double value, std::vector<double> const& shape,
                                  std::uint32_t index, double duration_s = 8.0) {
    CleanJoint joint = clean_joint();
    joint.plan.simulation.duration_s = duration_s;
    Recording recording = recorded(simulate_joint(joint.plan, index));
    if (name.empty()) return recording;
    Effect const& effect = *find_effect(name);
    Motion const motion = differentiate(recording, clean_filter(), {});
    Eigen::MatrixXd columns(motion.q.size(), static_cast<Eigen::Index>(effect.n_linear()));
    effect.columns({motion, measure_scales(motion, JointKind::revolute, 30.0, recording.rows.encoder_step)}, shape,
                   columns);
    recording.torque += value * columns.col(0);
    return recording;
  }

  StepwiseSearch searched(Recording const& recording, std::vector<char const*> const& names,
                          OtherRecordings const& others = {}) const {
    StageSetting const setting{recording, clean_regressor(), filter, section, 40, 1, 2};
    SelectionOptions options;
    for (auto const* name : names) options.candidates.push_back(find_effect(name));
    return search_stepwise(setting, options, levels, others, {});
  }

  FilterOptions const filter = clean_filter();
  Section const section{};
  DecisionLevels const levels{};
  std::vector<char const*> const laws{"stribeck", "spring", "cogging", "periodic_disturbance", "friction_drift"};
};

TEST_F(Stepwise, TakesNothingOfACleanRecording) {
  Recording const recording = recording_with("", 0.0, {}, 3);
  StepwiseSearch const search = searched(recording, laws);
  EXPECT_TRUE(search.end().selection.accepted.empty());
  EXPECT_TRUE(search.end().adequacy.holds());
  EXPECT_EQ(search.states.size(), 1U);
}

TEST_F(Stepwise, TakesTheLawThatIsThereAndThenStops) {
  Recording const recording = recording_with("spring", 0.4, {0.0, 0.0}, 3);
  StepwiseSearch const search = searched(recording, laws);
  auto const& accepted = search.end().selection.accepted;
  ASSERT_EQ(accepted.size(), 1U);
  EXPECT_EQ(accepted.front().effect->name(), "spring");
  EXPECT_FALSE(search.states.front().adequacy.holds());
  EXPECT_TRUE(search.end().adequacy.holds());
  KeptModel const kept = keep_what_predicts(search, {});
  EXPECT_TRUE(kept.is_held_out_lower);
  EXPECT_EQ(kept.state.selection.accepted.size(), 1U);
  EXPECT_GT(kept.held_out.explained.share, 0.9);
  EXPECT_LE(kept.held_out.explained.low, kept.held_out.explained.share);
}

// how far it had gone when another recording began nobody says; that one is longer, so that no weight of a training row
// can be one of its rows
TEST_F(Stepwise, TakesALawThatRunsDownWhereTheUnseenRecordingBeganWarmer) {
  Recording const recording = recording_with("thermal_friction", 0.3, {2.0}, 3);
  std::vector<Recording> const unseen{recording_with("thermal_friction", 0.12, {2.0}, 4, 12.0)};
  StepwiseSearch const search = searched(recording, {"thermal_friction", "spring", "cogging"}, {{}, unseen});
  auto const& accepted = search.end().selection.accepted;
  ASSERT_EQ(accepted.size(), 1U);
  EXPECT_EQ(accepted.front().effect->name(), "thermal_friction");
  EXPECT_TRUE(search.end().adequacy.holds());
  EXPECT_TRUE(keep_what_predicts(search, {{}, unseen}).is_held_out_lower);
}

TEST_F(Stepwise, TakesTheLawThatAllTrainingRecordingsHave) {
  Recording const recording = recording_with("spring", 0.4, {0.0, 0.0}, 3);
  std::vector<Recording> const further{recording_with("spring", 0.4, {0.0, 0.0}, 4)};
  StepwiseSearch const search = searched(recording, laws, {further, {}});
  auto const& accepted = search.end().selection.accepted;
  ASSERT_EQ(accepted.size(), 1U);
  EXPECT_EQ(accepted.front().effect->name(), "spring");
  EXPECT_TRUE(search.end().adequacy.holds());
  KeptModel const kept = keep_what_predicts(search, {further, {}});
  EXPECT_TRUE(kept.is_held_out_lower);
  EXPECT_EQ(kept.held_out.left.size(), 2U);  // each predicted by the fit to the other
}

TEST_F(Stepwise, IsNotContentWithALawThatOneTrainingRecordingHasNot) {
  Recording const recording = recording_with("spring", 0.4, {0.0, 0.0}, 3);
  std::vector<Recording> const further{recording_with("", 0.0, {}, 4)};
  StepwiseSearch const search = searched(recording, {"spring"}, {further, {}});
  EXPECT_FALSE(search.end().adequacy.holds());
}

// a law that acts in one tenth of the record is judged by that tenth
TEST_F(Stepwise, TakesALawThatActsInAFewStretchesOnly) {
  Recording const recording = recording_with("end_stop", 2.0, {0.5, 1.0}, 3);
  StepwiseSearch const search = searched(recording, {"end_stop", "spring", "cogging"});
  auto const& accepted = search.end().selection.accepted;
  ASSERT_EQ(accepted.size(), 1U);
  EXPECT_EQ(accepted.front().effect->name(), "end_stop");
}

// a spring over position and a wave over time are two things on a motion of many frequencies
TEST_F(Stepwise, ItsConfidenceSetHoldsNoLawThatPredictsClearlyWorse) {
  Recording const recording = recording_with("spring", 0.4, {0.0, 0.0}, 3);
  StepwiseSearch const search = searched(recording, laws);
  ASSERT_EQ(search.end().selection.accepted.size(), 1U);
  std::vector<Effect const*> catalogue;
  for (auto const* name : laws) catalogue.push_back(find_effect(name));
  EXPECT_TRUE(confidence_set(*search.end().evidence, 0, catalogue, levels, {}).empty());
}

}  // namespace stepwise_test
