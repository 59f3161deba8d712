// Friction that changes by itself: how much of it a recording shows, that nothing else is counted, and that it is
// neither named as a drift nor left unexplained.

#include "engine/infer/replicates/friction_wander.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/infer/moving_rows/stepwise.hpp"
#include "engine/infer/replicates/baseline_twin.hpp"
#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace friction_wander_test {

class FrictionWanders : public testing::Test {
 protected:
  static constexpr double duration_s = 32.0, coulomb = 1.3;

  static Recording steady_recording() {
    auto joint = clean_joint();
    joint.plan.simulation.duration_s = duration_s;
    return recorded(simulate_joint(joint.plan, 12));
  }

  static BaselineTwin made_from(Recording const& recording, RecordPipeline const& pipeline) {
    return make_baseline_twin(recording, pipeline, clean_filter(), {1e-4, 16, 1, 0}, 2);
  }

  // a twin is the only plant here whose friction wanders; whoever reads the recording is not told
  Recording wandering_recording(double wander, std::size_t lane) const {
    TwinLoop loop = made.twin.loop();
    loop.friction_wander = wander;
    CleanTwin const twin(made.twin.joint(), loop, made.twin.track(), made.twin.step_s());
    TwinGroup group;
    twin.simulate({5, 0, 0}, 0, group);
    Recording recording = steady;
    recording.position = group.position[lane];
    recording.torque = group.torque[lane];
    return recording;
  }

  static SearchState found_in(Recording const& recording, std::vector<Effect const*> candidates,
                              std::size_t twins = 48) {
    Section const no_section;
    FilterOptions const filter = clean_filter();
    SelectionOptions options;
    options.candidates = std::move(candidates);
    StageSetting const setting{recording, clean_regressor(), filter, no_section, twins, 1, 2};
    return search_stepwise(setting, options, {}, {}, {}).end();
  }

  struct Clean {
    Recording recording = steady_recording();
    RecordPipeline pipeline = clean_pipeline(recording);
    BaselineTwin twin = made_from(recording, pipeline);
  };
  // nobody changes it: made once for all tests
  static Clean const& clean() {
    static Clean const made_once;
    return made_once;
  }

  Recording const& steady = clean().recording;
  RecordPipeline const& pipeline = clean().pipeline;
  BaselineTwin const& made = clean().twin;
};

TEST_F(FrictionWanders, NotWhereItDoesNot) {
  EXPECT_LT(made.friction_wander.z, 4.0);
  EXPECT_LT(made.friction_wander.std, 0.001);  // by chance a little
}

TEST_F(FrictionWanders, AsMuchAsIsFound) {
  double const wander = 0.002;
  double sum = 0.0;
  for (std::size_t lane : {0U, 5U, 11U}) {
    auto const found = made_from(wandering_recording(wander, lane), pipeline).friction_wander;
    EXPECT_GT(found.z, 3.0);
    sum += found.std * found.std / 3.0;
  }
  EXPECT_NEAR(std::sqrt(sum), wander, 0.3 * wander);
}

TEST_F(FrictionWanders, NotWithoutAnEnd) {
  auto const found = made_from(wandering_recording(0.05, 3), pipeline).friction_wander;
  EXPECT_DOUBLE_EQ(found.std * std::sqrt(60.0), most_wander_in_a_minute);
}

TEST_F(FrictionWanders, NotWhenItDriftsOnNorWithTheMotion) {
  FrictionWander const statistic(made.record, pipeline, made.twin.joint(), WanderReading::beside_motion);
  ASSERT_TRUE(statistic.is_measurable());
  ProcessedRecord drifting = made.record, slow = made.record, jumping = made.record;
  Eigen::VectorXd const time = pipeline.picked(drifting.motion->time_s, drifting);
  Eigen::VectorXd const dq = pipeline.picked(drifting.motion->dq, drifting);
  for (Eigen::Index k = 0; k < time.size(); ++k) {
    double const friction = dq[k] > 0.0 ? coulomb : -coulomb;
    drifting.residual[k] += friction * 0.2 * time[k] / duration_s;                   // a fifth more at the end
    slow.residual[k] += friction * 0.2 * std::exp(-std::abs(dq[k]));                 // Stribeck
    jumping.residual[k] += friction * (std::fmod(time[k], 6.0) < 3.0 ? 0.02 : 0.0);  // this is one
  }
  // changes by a fifth count for less than a wander of 0.2 % in a second does, one of 2 % within three seconds for more
  double const small = 0.002 * 0.002 * statistic.duration_s() / 60.0;
  EXPECT_LT(statistic(drifting), small);
  EXPECT_LT(statistic(slow), small);
  EXPECT_GT(statistic(jumping), 10.0 * small);
}

// in both readings what is a parabola of the level is none of it, whatever the unit of torque
TEST_F(FrictionWanders, NotAsAParabolaInAnyUnit) {
  for (auto const reading : {WanderReading::beside_motion, WanderReading::by_itself})
    for (double const unit : {1e-4, 1.0, 1e4}) {
      TwinJoint joint = made.twin.joint();
      joint.coulomb_forward *= unit;
      joint.coulomb_backward *= unit;
      FrictionWander const statistic(made.record, pipeline, joint, reading);
      ProcessedRecord curved = made.record;
      Eigen::VectorXd const time = pipeline.picked(curved.motion->time_s, curved);
      Eigen::VectorXd const dq = pipeline.picked(curved.motion->dq, curved);
      for (Eigen::Index k = 0; k < time.size(); ++k) {
        double const friction = dq[k] > 0.0 ? joint.coulomb_forward : joint.coulomb_backward;
        curved.residual[k] = friction * (1.0 + 0.4 * std::pow(time[k] / duration_s, 2));
      }
      EXPECT_LT(statistic(curved), 1e-10) << unit;
    }
}

TEST_F(FrictionWanders, AndIsNeitherADriftNorUnexplained) {
  for (std::size_t lane : {0U, 1U}) {
    SearchState const found =
        found_in(wandering_recording(0.003, lane), {find_effect("friction_drift"), find_effect("thermal_friction")});
    EXPECT_TRUE(found.selection.accepted.empty());
    EXPECT_TRUE(found.adequacy.holds());
  }
}

// a walk is no ramp and no step, and weighed rows spread it over all its frequencies; yet more than any joint does by
// itself: a drift, or something that no law explains, and never nothing
TEST_F(FrictionWanders, AndIsSeenWhereItIsThreeTimesWhatIsPlausible) {
  for (std::size_t lane : {0U, 1U}) {
    SearchState const found = found_in(wandering_recording(3.0 * most_wander_in_a_minute / std::sqrt(60.0), lane),
                                       {find_effect("friction_drift"), find_effect("stribeck")}, 200);
    bool const is_named = !found.selection.accepted.empty();
    EXPECT_TRUE(is_named || found.adequacy.train.p < 0.02) << lane << ": p " << found.adequacy.train.p;
    // it is let pass only where it is below the engineer's tolerance
    bool const is_small = found.adequacy.train.excess_share < DecisionLevels{}.delta;
    EXPECT_TRUE(is_named || is_small || !found.adequacy.holds()) << lane;
    for (auto const& one : found.selection.accepted) EXPECT_EQ(one.effect->name(), "friction_drift");
  }
}

TEST_F(FrictionWanders, NotSoMuchThatADriftIsHidden) {
  // three tenths more friction at the end, in the torque channel: the loop has nothing to answer
  Recording recording = steady;
  auto const& dq = made.record.motion->dq;
  for (Eigen::Index k = 0; k < recording.torque.size(); ++k)
    recording.torque[k] += coulomb * std::tanh(dq[k] / 0.01) * 0.3 * recording.time_s[k] / duration_s;
  // beside friction that wanders a drift holds little weighed energy: the least p of few twins would not open the gate
  SearchState const found = found_in(recording, {find_effect("friction_drift"), find_effect("stribeck")}, 200);
  ASSERT_EQ(found.selection.accepted.size(), 1U);
  EXPECT_EQ(found.selection.accepted.front().effect->name(), "friction_drift");
}

}  // namespace friction_wander_test
