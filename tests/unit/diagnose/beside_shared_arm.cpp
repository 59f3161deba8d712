// Names that were found beside a refitted arm stand only where they beat the arm as it was.

#include "engine/diagnose/beside_shared_arm.hpp"

#include <gtest/gtest.h>

#include "engine/base/random_stream.hpp"

namespace torquescope {
namespace beside_shared_arm_test {

constexpr Eigen::Index rows = 2000, memory = 20;

Eigen::VectorXd residual(double size, std::uint32_t set) {
  RandomStream random({89, set, RandomDomain::test}, 0, 0);
  Eigen::VectorXd left(rows);
  for (double& value : left) value = size * random.normal();
  return left;
}

JointOutcome outcome(double before, double after, bool has_name) {
  JointOutcome made;
  JointDiagnosis joint;
  joint.validation_relerr = joint.cv_relerr = joint.train_relerr = before;
  joint.augmented_validation_relerr = joint.augmented_cv_relerr = after;
  TorqueTrace trace;
  trace.before = residual(before, 1);
  trace.after = residual(after, 2);
  joint.traces.push_back(std::move(trace));
  if (has_name) {
    NamedEffect spring;
    spring.name = "spring";
    joint.effects.push_back(spring);
    made.diagnosis.verdict = Verdict::named;
  } else {
    made.diagnosis.verdict = Verdict::unexplained;
  }
  made.diagnosis.joints.push_back(joint);
  return made;
}

Verdict verdict_beside(JointOutcome const& alone, JointOutcome refitted) {
  return beside_shared_arm(alone, std::move(refitted), {}, memory).diagnosis.verdict;
}

TEST(BesideSharedArm, ErrorsBeforeAreOfTheArmAlone) {
  // without its effect the refitted arm is far off, which is nobody's gain
  auto const told = beside_shared_arm(outcome(0.03, 0.03, false), outcome(0.09, 0.02, true), {}, memory);
  JointDiagnosis const& joint = told.diagnosis.joints.front();
  EXPECT_EQ(told.diagnosis.verdict, Verdict::named);
  EXPECT_DOUBLE_EQ(joint.validation_relerr, 0.03);
  EXPECT_DOUBLE_EQ(joint.train_relerr, 0.03);
  EXPECT_EQ(joint.traces.front().before, residual(0.03, 1));
  EXPECT_NE(told.diagnosis.reason.find("3.0 % to 2.0 %"), std::string::npos) << told.diagnosis.reason;
}

TEST(BesideSharedArm, NamesThatOnlyMendTheRefittedArmDoNotStand) {
  EXPECT_EQ(verdict_beside(outcome(0.03, 0.03, false), outcome(0.09, 0.031, true)), Verdict::unexplained);
  EXPECT_EQ(verdict_beside(outcome(0.03, 0.03, false), outcome(0.09, 0.029, true)), Verdict::unexplained);
}

TEST(BesideSharedArm, WithoutNamesTheArmAloneIsTold) {
  EXPECT_EQ(verdict_beside(outcome(0.03, 0.03, false), outcome(0.02, 0.02, false)), Verdict::unexplained);
}

TEST(BesideSharedArm, WithoutUnseenRecordingsBlocksLeftOutDecide) {
  auto alone = outcome(0.03, 0.03, false), refitted = outcome(0.09, 0.02, true);
  for (auto* one : {&alone, &refitted}) {
    auto& joint = one->diagnosis.joints.front();
    joint.validation_relerr = joint.augmented_validation_relerr = unknown;
  }
  EXPECT_EQ(verdict_beside(alone, refitted), Verdict::named);
  refitted.diagnosis.joints.front().augmented_cv_relerr = 0.0295;
  EXPECT_EQ(verdict_beside(alone, refitted), Verdict::unexplained);
}

}  // namespace beside_shared_arm_test
}  // namespace torquescope
