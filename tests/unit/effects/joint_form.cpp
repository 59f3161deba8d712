#include "engine/effects/joint_form.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "unit/effects/rich_motion.hpp"

namespace torquescope {
namespace joint_form_test {

TEST(JointForm, PredictsTheSameTorqueWhileTheJointMoves) {
  Regressor const seed({"inertia", "viscous", "coulomb_positive", "coulomb_negative"}, JointKind::revolute);
  Regressor const plain({"inertia", "viscous", "coulomb", "offset"}, JointKind::revolute);
  auto const form = joint_form(seed);
  ASSERT_TRUE(form.has_value());
  EXPECT_EQ(form->names, plain.names());
  EXPECT_EQ(form->units, plain.units());

  Eigen::Vector4d const paper(0.0036, 0.0164, 0.0089, -0.2582);
  Eigen::VectorXd const values = form->values(paper);
  EXPECT_NEAR(values[2], 0.13355, 1e-15);
  EXPECT_NEAR(values[3], -0.12465, 1e-15);
  auto const motion = test::rich_motion(90);
  Eigen::VectorXd const before = seed.columns(motion) * paper, after = plain.columns(motion) * values;
  for (Eigen::Index i = 0; i < 90; ++i) {
    if (motion.dq[i] == 0.0) continue;
    EXPECT_NEAR(before[i], after[i], 1e-15);
  }
}

TEST(JointForm, PropagatesTheCorrelationOfTheOneSidedParameters) {
  Regressor const seed({"coulomb_negative", "coulomb_positive"}, JointKind::revolute);
  auto const form = joint_form(seed);
  ASSERT_TRUE(form.has_value());
  EXPECT_THAT(form->names, testing::ElementsAre("offset", "coulomb"));
  Eigen::Matrix2d covariance;
  covariance << 0.04, 0.03, 0.03, 0.09;  // of (a4, a3)
  auto const errors = form->standard_errors(covariance);
  EXPECT_NEAR(errors[0], std::sqrt((0.04 + 0.09 + 2.0 * 0.03) / 4.0), 1e-15);  // offset = (a3 + a4) / 2
  EXPECT_NEAR(errors[1], std::sqrt((0.04 + 0.09 - 2.0 * 0.03) / 4.0), 1e-15);  // Fc = (a3 - a4) / 2
}

TEST(JointForm, ExistsOnlyForTheTwoSidedModel) {
  EXPECT_FALSE(joint_form(Regressor({"viscous", "coulomb", "offset"}, JointKind::revolute)).has_value());
  EXPECT_FALSE(joint_form(Regressor({"coulomb_positive"}, JointKind::revolute)).has_value());
}

}  // namespace joint_form_test
}  // namespace torquescope
