// Rows count by what replicates leave on them: least where the joint turns round, whatever is missing in the model.

#include "engine/infer/decision/row_weights.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/decision/plants.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace row_weights_test {

// rows of a joint, weighed by what replicates of its model leave
struct Weighed {
  std::vector<Recording> training, validation;
  Regressor terms = joint_terms();
  FilterOptions filter = ten_hertz();
  Section section{};
  DecisionQuestion question{training, validation, terms, filter, section};
  JointStrips plain, rows;
  FittedModel model;

  explicit Weighed(GivenJoint joint) {
    training = {recording_of(joint)};
    joint.pace = 0.87;
    joint.seed += 100;
    validation = {recording_of(joint)};
    question.training = training;
    question.validation = validation;
    question.seed = 3;
    plain = joint_strips(question);
    DelayChoice const delay = free_delay(question.numbers);
    FittedModel const alone = fitted_model(plain, terms, {}, nullptr, delay);
    model = fitted_model(plain, terms, {}, alone.fitted.get(), delay);
    rows = weighed_rows(question, plain, model);
  }
};

// mean weights of rows near a change of direction, and of all others
std::pair<double, double> near_and_far(Strip const& strip) {
  double near = 0.0, far = 0.0, n_near = 0.0, n_far = 0.0;
  Eigen::VectorXd const speed = strip.filters->effects->pick(strip.motion.dq)(strip.rows);
  for (Eigen::Index k = 2; k + 2 < speed.size(); ++k) {
    bool const turns = speed[k - 1] * speed[k + 1] < 0.0;
    bool const moves_on = speed.segment(k - 2, 5).minCoeff() > 0.0 || speed.segment(k - 2, 5).maxCoeff() < 0.0;
    if (turns) near += strip.row_weight[k], n_near += 1.0;
    if (!turns && moves_on) far += strip.row_weight[k], n_far += 1.0;
  }
  return {near / n_near, far / n_far};
}

TEST(RowWeights, RowsThatTurnRoundCountLess) {
  Weighed const joint{GivenJoint{}};
  for (auto const* strips : {joint.rows.training.get(), &std::as_const(joint.rows.validation)}) {
    Strip const& strip = strips->front();
    ASSERT_EQ(static_cast<std::size_t>(strip.row_weight.size()), strip.rows.size());
    EXPECT_GT(strip.row_weight.minCoeff(), 0.0);
    EXPECT_LE(strip.row_weight.maxCoeff(), 1.0);
    auto const [near, far] = near_and_far(strip);
    EXPECT_LT(near, far);
  }
}

TEST(RowWeights, SignalsOnTheRowsAreWeighed) {
  Weighed const joint{GivenJoint{}};
  Strip const &plain = joint.plain.training->front(), &weighed = joint.rows.training->front();
  Eigen::VectorXd const expected = weighed.row_weight.cwiseProduct(on_rows(plain, plain.torque).col(0));
  EXPECT_EQ(on_rows(weighed, weighed.torque).col(0), expected);
  EXPECT_DOUBLE_EQ(joint.rows.training_energy, expected.squaredNorm());
}

TEST(RowWeights, WhatIsMissingHidesNoRows) {
  GivenJoint lacking;
  lacking.effect = [](double q, double) { return 0.05 * std::sin(9.0 * q); };
  auto const [near, far] = near_and_far(Weighed{GivenJoint{}}.rows.training->front());
  auto const [near_lacking, far_lacking] = near_and_far(Weighed{lacking}.rows.training->front());
  // more is left everywhere, and replicates leave no more: rows count more alike
  EXPECT_GT(near_lacking, near);
  EXPECT_GE(far_lacking, far);
}

TEST(RowWeights, RowsThatCountAlikeAreThoseOfBefore) {
  Weighed const joint{GivenJoint{}};
  JointStrips const alike = unweighed_rows(joint.rows);
  EXPECT_EQ(alike.training_energy, joint.plain.training_energy);
  EXPECT_EQ(alike.validation_energy, joint.plain.validation_energy);
  FittedModel const again = fitted_alike(alike, joint.model);
  EXPECT_EQ(again.fitted->chosen().late_s, joint.model.fitted->chosen().late_s);
  EXPECT_NEAR(errors_of(alike, again).train, errors_of(joint.plain, joint.model).train, 1e-9);
}

}  // namespace row_weights_test
