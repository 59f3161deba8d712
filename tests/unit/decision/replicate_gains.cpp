// Replicates of a model: those within what the recording leaves, or, where too few are, those that leave the least.

#include "engine/infer/decision/replicate_gains.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/infer/decision/fitted_model.hpp"
#include "unit/decision/plants.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace replicate_gains_test {

struct Asked {
  ReplicateGains gains{};
  double left_by_recording = 0.0;  // squares
};

// no effect is asked for, and the smooth functions gain more than those of any replicate
Asked asked(GivenJoint const& joint, int threads) {
  std::vector<Recording> const training{recording_of(joint)};
  Regressor const terms = joint_terms();
  FilterOptions const filter = ten_hertz();
  Section const section{};
  DecisionQuestion question{training, {}, terms, filter, section};
  question.seed = 3;
  question.threads = threads;
  JointStrips const rows = joint_strips(question);
  FittedModel const model = fitted_model(rows, terms, {}, nullptr, {DelaySearch::everywhere, 0.15});
  Eigen::VectorXd const none{}, noise = model.fitted->residual();
  SmoothCorrections corrections =
      smooth_corrections(*model.fitted, {model.fitted->base(), model.fitted->residual(), model.fitted->guard()});
  corrections.gains.setConstant(1e9);
  AskedEffects const nothing{};
  std::vector<EffectQuestion> effects;
  ReplicateTask const task{model, noise, none, nothing, corrections};
  return {replicate_gains(question, task, effects), model.fitted->chosen().fit.energy()};
}

std::vector<double> squares_of(ReplicateGains const& gains) {
  std::vector<double> squares;
  for (Eigen::Index i = 0; i < gains.left.cols(); ++i) squares.push_back(gains.left.col(i).squaredNorm());
  return squares;
}

// The torque is that of the measured motion: no replicate, which sticks in a way of its own, leaves as little
GivenJoint without_noise() {
  GivenJoint joint;
  joint.noise = 0.0;
  joint.encoder_step = 1e-9;
  return joint;
}

TEST(ReplicateGains, WhereTooFewAreWithinTheRecordingTheNearestStandForThem) {
  Asked const one = asked(without_noise(), 1), two = asked(without_noise(), 2);
  EXPECT_EQ(one.gains.chance.replicates(), 24U);
  std::vector<double> const squares = squares_of(one.gains);
  ASSERT_EQ(squares.size(), 24U);
  EXPECT_TRUE(std::is_sorted(squares.begin(), squares.end()));
  EXPECT_GT(squares.front(), one.left_by_recording);
  // the same bits on any number of threads
  EXPECT_EQ(squares, squares_of(two.gains));
  EXPECT_EQ(one.gains.corrections.gains, two.gains.corrections.gains);
}

}  // namespace replicate_gains_test
