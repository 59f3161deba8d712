// The delay of a torque channel is found, late or early, and is none where the search would end.

#include "engine/infer/decision/treatment_choice.hpp"

#include <gtest/gtest.h>

#include "unit/decision/plants.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace treatment_choice_test {

ChosenTreatment chosen(double late_s, DelayChoice const& delay) {
  GivenJoint joint;
  joint.late_s = late_s;
  Strip const strip = strip_of_joint(joint);
  Regressor const terms = joint_terms();
  JointModel const model(terms);
  ModelOnStrips const on(model, {&strip, 1});
  return chosen_treatment(on, delay);
}

TEST(TreatmentChoice, FindsALateAndAnEarlyTorque) {
  for (double const late_s : {0.007, -0.007, 0.0, 0.061, -0.05}) {
    ChosenTreatment const found = chosen(late_s, {DelaySearch::everywhere, 0.15});
    EXPECT_NEAR(found.late_s, late_s + half_sample_s, 3e-4);
    EXPECT_FALSE(found.is_delay_at_bound);
    Eigen::ArrayXd const truth = truth_of({}).array();
    EXPECT_LT(((found.fit.parameters.array() - truth) / truth).abs().maxCoeff(), 0.01);
  }
}

TEST(TreatmentChoice, NearZeroASmallOneIsFound) {
  for (double const late_s : {0.004, -0.005})
    EXPECT_NEAR(chosen(late_s, {DelaySearch::near_zero, 0.15}).late_s, late_s + half_sample_s, 3e-4);
}

TEST(TreatmentChoice, AtTheBoundItIsNone) {
  for (double const late_s : {0.06, -0.06}) {
    ChosenTreatment const found = chosen(late_s, {DelaySearch::everywhere, 0.04});
    EXPECT_TRUE(found.is_delay_at_bound);
    EXPECT_EQ(found.late_s, 0.0);
  }
}

TEST(TreatmentChoice, AGivenOneIsKept) {
  ChosenTreatment const found = chosen(0.007, {DelaySearch::given, 0.15, 0.02});
  EXPECT_EQ(found.late_s, 0.02);
}

}  // namespace treatment_choice_test
