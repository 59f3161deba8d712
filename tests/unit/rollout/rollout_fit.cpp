// Levenberg-Marquardt on rollouts finds joints that another simulator recorded, in every loop, and says how well.

#include "engine/simulate/rollout/rollout_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "unit/rollout/recorded_joints.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace rollout_fit_test {

constexpr int samples = 1500;
constexpr CountedChannels both{true, true};
std::vector<std::string> const forms{"p", "pi", "pd", "pid", "p_velocity", "p_pi"};

// what the model begins with is a third too large or too small
Eigen::VectorXd rough(PlainJoint const& joint) {
  return truth_of(joint).cwiseProduct(Eigen::Vector4d(1.3, 0.7, 0.75, 1.3));
}

RolloutModel model_of(PlainJoint const& joint, LoopSetting const& loop, RolloutTrack const& track) {
  return {Regressor(joint_terms(), JointKind::revolute), rough(joint), scales_of(track, joint), {}, loop};
}

double gain(PlainController const& controller, LoopKey key) { return values_of(controller)[key]; }

TEST(RolloutFit, FindsJointAndGainsInEveryLoop) {
  for (auto const& form : forms) {
    PlainJoint const joint = dry_joint();
    PlainController const controller = controller_of(form);
    std::vector<RolloutTrack> const tracks{recorded(joint, controller, moved(samples), {})};
    RolloutModel const model = model_of(joint, free_loop(controller, tracks), tracks[0]);
    RolloutFit const fit = fit_rollouts(model, tracks, both, {}, 1, 1);
    ASSERT_FALSE(fit.failed) << form;
    EXPECT_TRUE(fit.at_bounds.empty()) << form;
    Eigen::VectorXd truth(fit.parameters.size());
    truth.head(4) = truth_of(joint);
    for (std::size_t k = 0; k < model.loop().free.size(); ++k)
      truth[4 + static_cast<Eigen::Index>(k)] = gain(controller, model.loop().free[k]);
    for (Eigen::Index k = 0; k < truth.size(); ++k) {
      auto const name = form + " " + model.names()[static_cast<std::size_t>(k)];
      double const off = std::abs(fit.parameters[k] - truth[k]);
      EXPECT_LT(off, 0.03 * std::abs(truth[k])) << name;
      EXPECT_LT(off, 4.5 * fit.errors[k]) << name;
      EXPECT_LT(fit.errors[k], 0.03 * std::abs(truth[k])) << name;
      EXPECT_NEAR(fit.upper[k] - fit.parameters[k], fit.parameters[k] - fit.lower[k], 1e-9);
      EXPECT_GE(fit.upper[k] - fit.parameters[k], 1.959 * fit.errors[k]);
    }
    // what is left is the noise of the sensors
    EXPECT_NEAR(std::sqrt(fit.sums[1] / samples), 0.02, 0.005) << form;
    EXPECT_LT(std::sqrt(fit.sums[0] / samples), 5e-4) << form;
  }
}

// a zero of the torque that moves from day to day is no friction of either
TEST(RolloutFit, GivesEveryRecordingAnOffsetOfItsOwn) {
  PlainController const controller = controller_of("pd");
  PlainJoint monday = dry_joint(), tuesday = dry_joint();
  monday.offset = 0.2;
  tuesday.offset = -0.1;
  std::vector<RolloutTrack> const tracks{recorded(monday, controller, moved(samples), {}),
                                         recorded(tuesday, controller, moved(samples), {5e-5, 0.02, 2})};
  RolloutModel const model = model_of(monday, free_loop(controller, {tracks[0]}), tracks[0]);
  RolloutFit const fit = fit_rollouts(model, tracks, both, {}, 1, 1);
  ASSERT_FALSE(fit.failed);
  EXPECT_NEAR(fit.parameters[3], 0.05, 0.01);  // their mean
  EXPECT_NEAR(fit.parameters[0], monday.inertia, 0.03 * monday.inertia);
  EXPECT_NEAR(fit.parameters[2], monday.forward, 0.03 * monday.forward);
  EXPECT_NEAR(std::sqrt(fit.sums[1] / (2.0 * samples)), 0.02, 0.005);
}

// many samples: what an iteration gains may be beyond chance, and no fall of the error
TEST(RolloutFit, EndsWhereAnIterationLowersTheSquaresByLessThanAsked) {
  PlainJoint const joint = dry_joint();
  PlainController const controller = controller_of("pd");
  std::vector<RolloutTrack> const tracks{recorded(joint, controller, moved(samples), {})};
  RolloutModel const model = model_of(joint, free_loop(controller, tracks), tracks[0]);
  LmOptions options;
  options.passes = 1;
  RolloutFit const whole = fit_rollouts(model, tracks, both, options, 1, 1);
  options.least_share = 1e6;  // more than there is
  RolloutFit const first = fit_rollouts(model, tracks, both, options, 1, 1);
  EXPECT_GT(whole.iterations, 1);
  EXPECT_EQ(first.iterations, 1);
  EXPECT_GE(first.objective, whole.objective);
  EXPECT_LT(first.evaluations, whole.evaluations);
}

// where the slope promises nothing, neither candidates nor wider differences are simulated
TEST(RolloutFit, AtRestCostsOneSlope) {
  PlainJoint joint = dry_joint();
  joint.forward = joint.backward = 0.0;
  PlainController const controller = controller_of("pd");
  std::vector<RolloutTrack> const tracks{recorded(joint, controller, moved(samples), {})};
  RolloutModel const model = model_of(joint, free_loop(controller, tracks), tracks[0]);
  LmOptions options;
  RolloutFit const rest = fit_rollouts(model, tracks, both, options, 1, 1);
  LoopSetting loop = model.loop();
  for (std::size_t k = 0; k < loop.free.size(); ++k)
    loop.values[loop.free[k]] = rest.parameters[4 + static_cast<Eigen::Index>(k)];
  RolloutModel const again(Regressor(joint_terms(), JointKind::revolute), rest.parameters.head(4),
                           scales_of(tracks[0], joint), {}, loop);
  options.passes = 1;
  RolloutFit const fit = fit_rollouts_from(again, tracks, both, rest.starts, options, 1);
  EXPECT_TRUE(rest.is_at_rest);
  EXPECT_TRUE(fit.is_at_rest);
  // its weights, then where it stands and two sides of each unknown
  EXPECT_EQ(fit.evaluations, 1 + 1 + 2 * (rest.parameters.size() + rest.starts.size()));
  EXPECT_EQ(fit.parameters, rest.parameters);
}

struct UnknownEffect {
  std::string name;
  std::vector<double> truth;  // of those that are searched
  std::map<std::string, double> given{};
  int samples = 0;
  std::int64_t starts = 4;
};

void expect_found(UnknownEffect const& effect, PlainJoint const& joint) {
  PlainController const controller = controller_of("p_velocity");
  std::vector<RolloutTrack> const tracks{recorded(joint, controller, moved(effect.samples), {})};
  JointScales scales = scales_of(tracks[0], joint);
  scales.cutoff_hz = 10.0;
  RolloutModel const model(Regressor(joint_terms(), JointKind::revolute), rough(joint), scales,
                           {{find_effect(effect.name), effect.given}}, free_loop(controller, tracks));
  LmOptions options;
  options.starts = effect.starts;
  RolloutFit const fit = fit_rollouts(model, tracks, both, options, 1, 1);
  ASSERT_FALSE(fit.failed) << effect.name;
  for (std::size_t k = 0; k < effect.truth.size(); ++k)
    EXPECT_NEAR(fit.parameters[static_cast<Eigen::Index>(4 + k)], effect.truth[k], 0.15 * effect.truth[k])
        << model.names()[4 + k];
  EXPECT_NEAR(fit.parameters[0], joint.inertia, 0.03 * joint.inertia) << effect.name;
  EXPECT_NEAR(std::sqrt(fit.sums[1] / effect.samples), 0.02, 0.005) << effect.name;
}

TEST(RolloutFit, FindsStribeckFrictionWhoseSpeedIsUnknown) {
  PlainJoint joint = dry_joint();
  joint.sliding = [](double speed) { return 0.25 * std::exp(-std::pow(speed / 0.25, 2.0)); };
  // of an exponent three seconds say next to nothing
  expect_found({"stribeck", {0.25, 0.25}, {{"stribeck_exponent", 2.0}}, samples}, joint);
}

TEST(RolloutFit, FindsCoggingWhoseOrderIsUnknown) {
  PlainJoint joint = dry_joint();
  joint.smooth = [](double, double q) { return 0.15 * std::cos(14.0 * q) + 0.1 * std::sin(14.0 * q); };
  // an order is told from those that make half a wave more over the travel: as many starts as there are of these
  expect_found({"cogging", {0.15, 0.1, 14.0}, {}, 700, 40}, joint);
}

TEST(RolloutFit, IsTheSameOnAnyNumberOfThreads) {
  PlainJoint const joint = dry_joint();
  PlainController const controller = controller_of("pd");
  std::vector<RolloutTrack> const tracks{recorded(joint, controller, moved(600), {}),
                                         recorded(joint, controller, moved(500), {.seed = 2})};
  RolloutModel const model = model_of(joint, free_loop(controller, tracks), tracks[0]);
  RolloutFit const one = fit_rollouts(model, tracks, both, {}, 1, 1), two = fit_rollouts(model, tracks, both, {}, 2, 1);
  EXPECT_TRUE(same_bits(one.parameters, two.parameters));
  EXPECT_TRUE(same_bits(one.errors, two.errors));
  EXPECT_EQ(one.sums, two.sums);
  EXPECT_EQ(one.evaluations, two.evaluations);
}

TEST(RolloutFit, NamesTheBoundsItEndsAt) {
  // a controller that feeds more of the speed forward than anybody would
  PlainJoint const joint = dry_joint();
  PlainController controller = controller_of("pd");
  controller.feed_speed = 3.0;
  std::vector<RolloutTrack> const tracks{recorded(joint, controller, moved(samples), {})};
  LoopSetting loop;
  loop.form = LoopForm::pd;
  loop.values = values_of(controller);
  loop.values[LoopKey::feed_speed] = 1.0;
  loop.free = {LoopKey::feed_speed};
  RolloutModel const model = model_of(joint, loop, tracks[0]);
  RolloutFit const fit = fit_rollouts(model, tracks, both, {}, 1, 1);
  ASSERT_FALSE(fit.failed);
  EXPECT_EQ(fit.parameters[4], 2.0);
  EXPECT_THAT(fit.at_bounds, testing::ElementsAre("loop_feed_speed"));
  EXPECT_TRUE(std::isnan(fit.errors[4])) << "no interval at a bound";
  EXPECT_TRUE(fit.errors.head(4).allFinite());
}

TEST(RolloutFit, ThatCannotBeginHasFailed) {
  PlainJoint const joint = dry_joint();
  PlainController const controller = controller_of("pd");
  std::vector<RolloutTrack> const tracks{recorded(joint, controller, moved(600), {})};
  LoopSetting loop = free_loop(controller, tracks);
  loop.values[LoopKey::kp] = 18.0;
  loop.values[LoopKey::kd] = 400.0;  // many times what a loop of 500 Hz can bear
  RolloutModel const model = model_of(joint, loop, tracks[0]);
  RolloutFit const fit = fit_rollouts(model, tracks, both, {}, 1, 1);
  EXPECT_TRUE(fit.failed);
  EXPECT_TRUE(same_bits(fit.parameters, model.start()));
  EXPECT_TRUE(fit.errors.array().isNaN().all());
  EXPECT_TRUE(std::isinf(fit.objective));
}

TEST(RolloutFit, StopsWhenAskedWithTheBestSoFar) {
  PlainJoint const joint = dry_joint();
  PlainController const controller = controller_of("pd");
  std::vector<RolloutTrack> const tracks{recorded(joint, controller, moved(600), {})};
  RolloutModel const model = model_of(joint, free_loop(controller, tracks), tracks[0]);
  int asked = 0;
  RolloutFit const fit = fit_rollouts(model, tracks, both, {}, 1, 1, [&] { return ++asked > 1; });
  EXPECT_FALSE(fit.failed);
  EXPECT_EQ(fit.iterations, 1);
}

TEST(RolloutFit, DryFrictionComesBackFromZero) {
  PlainJoint const joint = dry_joint();
  std::vector<RolloutTrack> const tracks{recorded(joint, controller_of("pd"), moved(samples), {})};
  Eigen::VectorXd start = truth_of(joint);
  start[2] = 0.0;
  RolloutModel const model(Regressor(joint_terms(), JointKind::revolute), start, scales_of(tracks[0], joint), {},
                           free_loop(controller_of("pd"), tracks));
  EXPECT_NEAR(fit_rollouts(model, tracks, both, {}, 1, 1).parameters[2], joint.forward, 0.03 * joint.forward);
}

}  // namespace rollout_fit_test
