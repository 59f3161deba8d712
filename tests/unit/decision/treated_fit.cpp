// One fit to all samples: a rest inside the interval of static friction costs no parameter its value.

#include "engine/infer/decision/treated_fit.hpp"

#include <gtest/gtest.h>

#include "unit/decision/plants.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace treated_fit_test {

// largest deviation from the truth, as a share of it
double worst(Eigen::VectorXd const& parameters, GivenJoint const& joint) {
  Eigen::ArrayXd const truth = truth_of(joint).array();
  return ((parameters.array() - truth) / truth).abs().maxCoeff();
}

void expect_mixture(Eigen::VectorXd const& sticking) {
  EXPECT_GE(sticking.minCoeff(), 0.0);
  EXPECT_LE(sticking.maxCoeff(), 1.0);
  EXPECT_LE(sticking.sum(), 1.0 + 1e-12);
}

TEST(TreatedFit, FindsTheParametersOfAJointThatRests) {
  GivenJoint joint;
  joint.rests = true;
  Strip const strip = strip_of_joint(joint);
  Regressor const terms = joint_terms();
  JointModel const model(terms);
  ModelOnStrips const on(model, {&strip, 1});
  TreatedFit const fit = treated_fit(on, half_sample_s);
  EXPECT_LT(worst(fit.parameters, joint), 0.01);
  expect_mixture(fit.sticking);
  // plain least squares, the sign of the direction at all samples
  SampleTreatment const plain{Eigen::VectorXd::Ones(strip.size()), strip.direction};
  Eigen::MatrixXd const columns = model_on_rows(on, {plain});
  Eigen::VectorXd const torque = torque_on_rows(on, {plain}, half_sample_s);
  Eigen::VectorXd const untreated = columns.colPivHouseholderQr().solve(torque);
  EXPECT_GT(worst(untreated, joint), 0.05);
  // in the middle of a rest nothing counts; where it moves everything does
  for (Eigen::Index k = 0; k < strip.size(); ++k) {
    double const u = std::fmod(strip.motion.time_s[k], rest_period_s);
    bool const rests = u > rest_from_s + 0.2 && u < rest_until_s - 0.2;
    bool const moves = u > 0.2 && u < slows_s && strip.is_quiet[static_cast<std::size_t>(k)] == 0;
    if (rests || moves) {
      EXPECT_EQ(fit.samples[0].weight[k], rests ? 0.0 : 1.0) << u;
    }
  }
}

TEST(TreatedFit, FindsTheParametersAndTheOffsetOfASecondRecording) {
  GivenJoint first, second;
  second.offset = 0.35;
  second.pace = 0.83;
  second.seed = 2;
  std::vector<Strip> const strips{strip_of_joint(first), strip_of_joint(second)};
  Regressor const terms = joint_terms();
  JointModel const model(terms);
  ModelOnStrips const on(model, strips);
  TreatedFit const fit = treated_fit(on, half_sample_s);
  ASSERT_EQ(fit.parameters.size(), 5);
  EXPECT_LT(worst(fit.parameters.head(4), first), 0.01);
  EXPECT_NEAR(fit.parameters[4], 0.15, 0.003);
  expect_mixture(fit.sticking);
}

// friction that creeps through zero is no sign: the mixture finds its side
TEST(TreatedFit, FindsFrictionThatCreeps) {
  GivenJoint joint;
  constexpr double creep = 0.02;
  joint.effect = [&](double, double dq) { return joint.coulomb * (std::tanh(dq / creep) - (dq > 0.0 ? 1.0 : -1.0)); };
  Strip const strip = strip_of_joint(joint);
  Regressor const terms = joint_terms();
  JointModel const model(terms);
  ModelOnStrips const on(model, {&strip, 1});
  TreatedFit const fit = treated_fit(on, half_sample_s);
  expect_mixture(fit.sticking);
  EXPECT_GT(fit.sticking.sum(), 0.5);
  EXPECT_LT(worst(fit.parameters, joint), 0.01);
}

TEST(TreatedFit, ACubicIsMovedExactly) {
  constexpr double rate_hz = 50.0;
  auto const cubic = [](double t) { return 1.0 - 2.0 * t + 0.7 * t * t - 0.4 * t * t * t; };
  Eigen::VectorXd signal(200);
  for (Eigen::Index k = 0; k < 200; ++k) signal[k] = cubic(static_cast<double>(k) / rate_hz);
  for (double const late_s : {0.013, -0.013, 0.06, -0.047, 0.04}) {
    Eigen::VectorXd const moved = earlier(signal, late_s, rate_hz);
    for (Eigen::Index k = 10; k < 190; ++k)
      ASSERT_NEAR(moved[k], cubic(static_cast<double>(k) / rate_hz + late_s), 1e-10) << late_s;
  }
  EXPECT_EQ(earlier(signal, 0.0, rate_hz), signal);
}

TEST(TreatedFit, ASineIsMovedToAThousandth) {
  constexpr double rate_hz = 100.0, turns = 2.0 * std::numbers::pi * 4.0;
  Eigen::VectorXd signal(300);
  for (Eigen::Index k = 0; k < 300; ++k) signal[k] = std::sin(turns * static_cast<double>(k) / rate_hz);
  for (double const late_s : {0.005, -0.0123, 0.0456}) {
    Eigen::VectorXd const moved = earlier(signal, late_s, rate_hz);
    for (Eigen::Index k = 10; k < 290; ++k)
      ASSERT_NEAR(moved[k], std::sin(turns * (static_cast<double>(k) / rate_hz + late_s)), 1e-3) << late_s;
  }
}

}  // namespace treated_fit_test
