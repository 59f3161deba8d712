// A stage's parameters are those of the joint also where processing takes more from an effect than there is of it.

#include "engine/infer/search/model_stage.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace model_stage_test {

// A coarse encoder makes the acceleration noisy, so that its columns take less than their due, and what follows the
// load gets the less of it the smaller it is
class ModelStageOfACoarseEncoder : public testing::Test {
 protected:
  static Recording coarse() {
    auto joint = clean_joint();
    joint.plan.noise.torque_std = 0.001;
    joint.plan.encoder.counts_per_revolution = 0.1 * counts_per_revolution;
    Recording recording = recorded(simulate_joint(joint.plan, 500));
    recording.rows.encoder_step *= 10.0;
    return recording;
  }

  static StageSetting setting_of(Recording const& recording) {
    static FilterOptions const filter = clean_filter();
    static Section const section{};
    return {recording, clean_regressor(), filter, section, 32, 1, 2};
  }

  JointModel with_effect() const {
    std::vector<ShapedEffect> effects{{find_effect("load_dependent_friction"), {1.0, 0.0}}};
    return JointModel(clean_regressor(), plain.reference(), std::move(effects));
  }

  // of the same joint with this much of the effect, in the same loop, with noise that no stage's twins have
  Recording with(double size, std::uint32_t which) const {
    Eigen::VectorXd parameters(5);
    parameters << plain.parameters(), size;
    auto const& loop = plain.twin->loop;
    CleanTwin const joint(with_effect().twin_joint(parameters), loop.loop, loop.track, plain.twin->twin.step_s());
    TwinGroup group;
    joint.simulate({which, 0, 900}, 0, group);
    Recording recording = clean;
    recording.position = group.position[0];
    recording.torque = group.torque[0];
    return recording;
  }

  Recording const clean = coarse();
  ModelStage const plain = make_stage(setting_of(clean), clean_regressor()).value();
};

TEST_F(ModelStageOfACoarseEncoder, FindsAnEffectThatIsSmallerThanItsBias) {
  // what the encoder takes is put back fivefold, and the noise with it: one record is off by half of the size
  constexpr double size = 0.002;
  constexpr std::uint32_t records = 8;
  double sum = 0.0;
  for (std::uint32_t which = 1; which <= records; ++which) {
    Recording const recording = with(size, which);
    ModelStage const stage = make_stage(setting_of(recording), with_effect()).value();
    EXPECT_LT(stage.twin->baseline.least_squares[4], size / 3.0) << "least squares finds a third of it at most";
    EXPECT_GT(stage.parameters()[4], 0.0);
    sum += stage.parameters()[4];
  }
  EXPECT_GT(sum / records, 0.5 * size);
  EXPECT_LT(sum / records, 1.5 * size);
}

TEST_F(ModelStageOfACoarseEncoder, IsFarTooLargeBeyondTwiceTheBoundOfEitherStage) {
  Recording const recording = with(0.002, 1);
  ModelStage stage = make_stage(setting_of(recording), with_effect()).value();
  JointScales const before = plain.reference().scales;
  double const most = stage.model().effects().back().effect->linear_bounds(before).front().upper;
  ASSERT_GT(most, 0.0);
  EXPECT_FALSE(is_far_too_large(stage, before));
  stage.twin->baseline.parameters[4] = 1.9 * most;
  EXPECT_FALSE(is_far_too_large(stage, before));
  stage.twin->baseline.parameters[4] = 2.1 * most;
  EXPECT_TRUE(is_far_too_large(stage, before));
}

TEST_F(ModelStageOfACoarseEncoder, FitsWithinBoundsWhatIsNothingWithoutItsBias) {
  Recording recording = clean;
  recording.torque.array() -= 0.01 * recording.torque.array().cube();
  std::vector<ShapedEffect> effects{{find_effect("torque_constant"), {}}};
  ModelStage const stage =
      make_stage(setting_of(recording), JointModel(clean_regressor(), plain.reference(), std::move(effects))).value();
  EXPECT_TRUE(stage.pipeline->bounds_effects());
  EXPECT_EQ(stage.twin->baseline.least_squares[4], 0.0);
  EXPECT_EQ(stage.parameters()[4], 0.0);
}

}  // namespace model_stage_test
