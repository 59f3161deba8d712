// An ablation takes away what it says and nothing else.

#include "engine/infer/replicates/ablation.hpp"

#include <gtest/gtest.h>

#include "unit/replicates/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace ablation_test {

// a loop with everything random that twins can have
class AblationTest : public testing::Test {
 protected:
  static Recording noisy_recording() {
    auto joint = clean_joint();
    joint.plan.simulation.duration_s = 4.0;
    joint.plan.noise.disturbance_std = 0.05;
    return recorded(simulate_joint(joint.plan, 3));
  }

  BaselineTwin ablated(Ablation const& ablation) const {
    BaselineTwin made = make_baseline_twin(recording, pipeline, clean_filter(), {}, 2);
    ablate_twin(made, pipeline, ablation);
    return made;
  }

  Recording const recording = noisy_recording();
  RecordPipeline const pipeline{clean_regressor(), clean_filter(), recording.rate_hz, recording.position.size()};
};

TEST_F(AblationTest, TheWholeMethodIsLeftAlone) {
  BaselineTwin const plain = make_baseline_twin(recording, pipeline, clean_filter(), {}, 2);
  BaselineTwin const made = ablated({.null = NullKind::iid});
  EXPECT_EQ(made.baseline.parameters, plain.baseline.parameters);
  EXPECT_EQ(made.twin.loop().torque_noise.std, plain.twin.loop().torque_noise.std);
  EXPECT_EQ(made.twin.joint().lanes.inertia, plain.twin.joint().lanes.inertia);
}

TEST_F(AblationTest, WithoutIndirectInferenceTheTwinIsTheLeastSquaresFit) {
  BaselineTwin const plain = ablated({}), made = ablated({.indirect_inference = false});
  EXPECT_EQ(made.baseline.parameters, made.record.parameters);
  EXPECT_NE(made.baseline.parameters, plain.baseline.parameters);
  EXPECT_EQ(made.twin.joint().lanes.inertia, made.record.parameters[0]);
  EXPECT_EQ(made.twin.loop().disturbance_std, plain.twin.loop().disturbance_std);
}

TEST_F(AblationTest, MisstatedNoiseScalesAllThatIsRandomButTheEncoder) {
  TwinLoop const plain = ablated({}).twin.loop();
  BaselineTwin const made = ablated({.twin_noise = 2.0});
  ASSERT_GT(plain.torque_noise.std, 0.0);
  ASSERT_GT(plain.disturbance_std, 0.0);
  TwinLoop const loud = made.twin.loop();
  EXPECT_EQ(loud.torque_noise.std, 2.0 * plain.torque_noise.std);
  EXPECT_EQ(loud.torque_noise.innovation, 2.0 * plain.torque_noise.innovation);
  EXPECT_EQ(loud.disturbance_std, 2.0 * plain.disturbance_std);
  EXPECT_EQ(loud.disturbance_variance_error, 4.0 * plain.disturbance_variance_error);
  EXPECT_EQ(loud.friction_wander, 2.0 * plain.friction_wander);
  EXPECT_EQ(loud.encoder_step, plain.encoder_step);
  // what later stages begin with is not scaled, or it would be scaled twice
  EXPECT_EQ(made.loop.loop.torque_noise.std, plain.torque_noise.std);
}

}  // namespace ablation_test
