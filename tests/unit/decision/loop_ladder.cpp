// A ladder of simulations finds what acts between command and motor, and a wave of the torque, in plants that share no
// code with it; of a joint that is complete it takes nothing.

#include "engine/infer/decision/loop_ladder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "engine/base/random_stream.hpp"
#include "engine/infer/decision/loop_moves.hpp"
#include "unit/rollout/loops.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace loop_ladder_test {

constexpr double rate_hz = 100.0, encoder_step = 1.5e-3, turn = 2.0 * std::numbers::pi;

struct Planted {
  double speed_limit = 0.0, delay_s = 0.0, cogging = 0.0, spring = 0.0;  // 0: none
  double hardening = 0.0, rest = 0.0;                                    // of the spring
  std::uint64_t seed = 1;
  double seconds = 6.0;
};

// two sines and a step now and then, as a servo is sent
std::vector<double> commanded(double pace, double seconds) {
  std::vector<double> goal;
  for (int k = 0; k < seconds * rate_hz; ++k) {
    double const t = k / rate_hz * pace;
    double const steps = std::fmod(t, 2.0) < 1.0 ? 0.0 : 0.5;
    goal.push_back(0.6 * std::sin(turn * 0.4 * t) + 0.3 * std::sin(turn * 0.9 * t + 1.0) + steps - 0.25);
  }
  return goal;
}

// a goal that follows the command no faster than the limit
std::vector<double> led(std::vector<double> goal, double limit) {
  if (limit == 0.0) return goal;
  double at = goal.front();
  for (double& one : goal) one = at += std::min(std::max(one - at, -limit / rate_hz), limit / rate_hz);
  return goal;
}

RolloutTrack recorded(Planted const& planted, double pace) {
  PlainJoint joint;
  joint.inertia = 0.05;
  joint.viscous = 0.6;
  joint.forward = 0.1;
  joint.backward = -0.1;
  joint.offset = 0.05;
  if (planted.cogging > 0.0) joint.smooth = [=](double, double q) { return planted.cogging * std::sin(7.0 * q + 0.4); };
  if (planted.spring > 0.0)
    joint.smooth = [=](double, double q) {
      return planted.spring * (q + planted.hardening * std::pow(q - planted.rest, 3));
    };
  PlainController controller;
  controller.form = "p";
  controller.kp = 5.0;
  controller.command_delay_s = planted.delay_s;
  PlainInputs inputs;
  inputs.rate_hz = rate_hz;
  inputs.straight = true;
  inputs.reference = led(commanded(pace, planted.seconds), planted.speed_limit);
  PlainStart const start{inputs.reference.front(), 0.0, 0.0};
  PlainMotion motion = PlainLoop(joint, controller, inputs, start, 10, encoder_step).run();
  RandomStream random({planted.seed, 0, RandomDomain::test}, 0, static_cast<std::uint32_t>(pace * 100.0));
  for (double& torque : motion.torque) torque += 0.01 * random.normal();
  for (double& position : motion.position) position += 5e-4 * random.normal();
  inputs.reference = commanded(pace, planted.seconds);
  RolloutTrack track = track_of(inputs, {start.position, 0.0, 0.0}, motion);
  track.straight_reference = true;
  track.encoder_step = encoder_step;
  return track;
}

struct Asked {
  Regressor terms{{"inertia", "viscous", "coulomb", "offset"}, JointKind::revolute};
  Eigen::VectorXd start = Eigen::Vector4d(0.04, 0.7, 0.07, 0.0);
  JointScales scales{};
  LoopSetting loop{};
  std::vector<RolloutTrack> fitted, training, validation;  // training: all of it
  LoopQuestion question(int threads) const {
    LoopQuestion question{terms, start, scales, loop, fitted, training, validation};
    question.moves = drive_moves(loop, training, drive_effects_of(DriveEffectKind::profile));
    question.moves.push_back(effect_move(*find_effect("cogging"), {7.1}, scales));
    question.moves.push_back(effect_move(*find_effect("asymmetric_viscous"), {}, scales));
    question.moves.push_back(effect_move(*find_effect("spring"), {}, scales));
    question.seed = 5;
    question.threads = threads;
    return question;
  }
  LoopFacts climbed(int threads) const { return climb_ladder(question(threads)).facts; }
};

Asked asked_of(Planted const& planted) {
  Asked asked;
  asked.training.push_back(recorded(planted, 1.0));
  asked.fitted = asked.training;
  asked.validation.push_back(recorded(planted, 0.83));
  RolloutTrack const& track = asked.training.front();
  asked.scales.rate_hz = rate_hz;
  asked.scales.duration_s = 6.0;
  asked.scales.peak_speed = 4.0;
  asked.scales.position_range = track.position.maxCoeff() - track.position.minCoeff();
  asked.scales.encoder_step = encoder_step;
  asked.scales.torque_rms = std::sqrt(track.torque.squaredNorm() / static_cast<double>(track.torque.size()));
  asked.scales.torque_peak = track.torque.cwiseAbs().maxCoeff();
  asked.scales.coulomb_positive = asked.scales.coulomb_negative = 0.1;
  asked.scales.inertia = 0.05;
  asked.loop.form = LoopForm::p;
  asked.loop.values[LoopKey::kp] = 5.0;
  return asked;
}

std::vector<std::string> names_of(LoopFacts const& facts) {
  std::vector<std::string> names;
  for (auto const& move : facts.kept) names.push_back(name_of(move.subject));
  return names;
}

using Names = std::vector<std::string>;

TEST(LoopLadder, FindsASpeedLimitOfTheCommand) {
  for (std::uint64_t const seed : {1u, 2u, 3u}) {
    LoopFacts const facts = asked_of({.speed_limit = 1.8, .seed = seed}).climbed(1);
    ASSERT_EQ(facts.reason, LoopReason::decides);
    ASSERT_EQ(names_of(facts), Names{"goal_speed_limit"}) << seed;
    EXPECT_NEAR(facts.kept[0].numbers[0].value, 1.8, 0.05);
    EXPECT_LT(facts.final_validation.position, 0.3 * facts.base_validation.position);
  }
}

TEST(LoopLadder, FindsADelayOfTheCommand) {
  for (std::uint64_t const seed : {1u, 2u, 3u}) {
    LoopFacts const facts = asked_of({.delay_s = 0.04, .seed = seed}).climbed(1);
    ASSERT_EQ(names_of(facts), Names{"command_delay"}) << seed;
    EXPECT_NEAR(facts.kept[0].numbers[0].value, 0.04, 0.004);
  }
}

TEST(LoopLadder, ADelayBelowHalfASampleIsNoName) {
  LoopFacts const facts = asked_of({.delay_s = 0.004}).climbed(1);
  EXPECT_TRUE(facts.kept.empty());
  auto const& moves = facts.steps.front().moves;
  auto const delay = std::find_if(moves.begin(), moves.end(),
                                  [](MoveFacts const& move) { return name_of(move.subject) == "command_delay"; });
  ASSERT_NE(delay, moves.end());
  EXPECT_EQ(delay->refusal, MoveRefusal::too_small);
}

TEST(LoopLadder, FindsCoggingWhereNothingActsOnTheCommand) {
  for (std::uint64_t const seed : {1u, 2u, 3u}) {
    LoopFacts const facts = asked_of({.cogging = 0.1, .seed = seed}).climbed(1);
    ASSERT_EQ(names_of(facts), Names{"cogging"}) << seed;
    EXPECT_LT(facts.final_validation.both(), 0.7 * facts.base_validation.both());
  }
}

TEST(LoopLadder, TakesNothingOfACompleteJoint) {
  for (std::uint64_t const seed : {1u, 2u, 3u, 4u}) {
    LoopFacts const facts = asked_of({.seed = seed}).climbed(1);
    EXPECT_EQ(names_of(facts), Names{}) << seed;
    EXPECT_EQ(facts.reason, LoopReason::decides);
  }
}

TEST(LoopLadder, PoolsRecordingsOfOneJoint) {
  Planted const planted{.speed_limit = 1.8};
  Asked asked = asked_of(planted);
  asked.training.push_back(recorded(planted, 0.7));
  asked.fitted = asked.training;
  LoopFacts const facts = asked.climbed(2);
  ASSERT_EQ(names_of(facts), Names{"goal_speed_limit"});
  EXPECT_NEAR(facts.kept[0].numbers[0].value, 1.8, 0.05);
}

// what lies between the stretches is wrong here: no fit sees it, and the error of training does
TEST(LoopLadder, FitsStretchesAndTellsErrorsOfAllSamples) {
  Asked asked = asked_of({.speed_limit = 1.8, .seconds = 48.0});
  RolloutTrack& track = asked.fitted.front();
  track = in_stretches(track, track.samples() / 2);
  RolloutTrack& all = asked.training.front();
  all.position.array() += 0.1;
  for (auto const& segment : track.segments) all.position.segment(segment.first, segment.samples).array() -= 0.1;
  LoopQuestion question = asked.question(1);
  question.moves = drive_moves(question.loop, asked.training, drive_effects_of(DriveEffectKind::profile));
  LoopFacts const facts = climb_ladder(question).facts;
  ASSERT_EQ(names_of(facts), Names{"goal_speed_limit"});
  EXPECT_NEAR(facts.kept[0].numbers[0].value, 1.8, 0.05);
  EXPECT_NEAR(facts.fitted_share, 0.5, 0.01);
  EXPECT_LT(facts.final_validation.position, 0.3 * facts.base_validation.position);
  EXPECT_GT(facts.final_train.position, 10.0 * facts.final_validation.position);
}

TEST(LoopLadder, SaysThatAModelPredictsNothing) {
  Asked asked = asked_of({});
  asked.training.front().position *= -1.0;
  asked.fitted = asked.training;
  EXPECT_NE(asked.climbed(1).reason, LoopReason::decides);
}

// the spring fitted to a planted one, its rest put to the lower end of the travel
struct FittedSpring {
  Asked asked;
  LoopQuestion question;
  std::size_t move;
  LoopFit without, with;

  explicit FittedSpring(Planted const& planted) : asked(asked_of(planted)), question(asked.question(1)) {
    move = static_cast<std::size_t>(std::find_if(question.moves.begin(), question.moves.end(),
                                                 [](auto const& one) { return name_of(one.subject) == "spring"; }) -
                                    question.moves.begin());
    without = fitted(question, base_point(question));
    with = fitted(question, with_move(question, without.point, move, question.moves[move].starts.front()));
  }
  Eigen::Index place(std::string const& name) const {
    auto const numbers = with.point.model(question).parameters();
    auto const found = std::find_if(numbers.begin(), numbers.end(), [&](auto const& one) { return one.name == name; });
    return found - numbers.begin();
  }
  double value(std::string const& name) const { return with.fit.parameters[place(name)]; }
  double lowest(std::string const& name) const {
    return with.point.model(question).parameters()[static_cast<std::size_t>(place(name))].lower;
  }
};

// a spring whose rest is at the end of the travel: it says nothing of one that hardly hardens
TEST(LoopLadder, ANumberIsAtItsBoundWhereTheGainHangsOnIt) {
  FittedSpring straight({.spring = 0.3});
  ASSERT_FALSE(straight.with.fit.failed);
  EXPECT_NEAR(straight.value("spring"), 0.3, 0.02);
  straight.with.fit.parameters[straight.place("spring_rest")] = straight.lowest("spring_rest");
  EXPECT_FALSE(is_at_bound(straight.question, straight.without, straight.with, straight.move));

  FittedSpring const bent({.spring = 0.2, .hardening = 0.4, .rest = -2.5});
  ASSERT_FALSE(bent.with.fit.failed);
  EXPECT_DOUBLE_EQ(bent.value("spring_rest"), bent.lowest("spring_rest"));
  EXPECT_TRUE(is_at_bound(bent.question, bent.without, bent.with, bent.move));
}

std::vector<double> numbers_in(LoopFacts const& facts) {
  std::vector<double> all{facts.final_train.position, facts.final_train.torque, facts.final_validation.position,
                          facts.final_validation.torque};
  for (auto const& step : facts.steps)
    for (auto const& move : step.moves) all.insert(all.end(), {move.gain, move.p, move.level, move.before.both()});
  for (auto const& one : facts.numbers) all.insert(all.end(), {one.value, one.lower, one.upper});
  return all;
}

TEST(LoopLadder, IsTheSameOnTwoThreads) {
  Asked const asked = asked_of({.speed_limit = 1.8});
  auto const one = numbers_in(asked.climbed(1)), two = numbers_in(asked.climbed(2));
  ASSERT_EQ(one.size(), two.size());
  EXPECT_EQ(std::memcmp(one.data(), two.data(), one.size() * sizeof(double)), 0);
}

// 1e5 |dq|^1.0001 less as much viscous friction would fit as well as any gentle curve
TEST(LoopModel, APowerLawOfTheFirstPowerIsAtItsBound) {
  Asked const asked = asked_of({});
  LoopQuestion question = asked.question(1);
  std::size_t const move = question.moves.size();
  question.moves.push_back(effect_move(*find_effect("power_law_viscous"), {0.6}, asked.scales));
  LoopFit const without = fitted(question, base_point(question), LoopSearch::a_look);
  LoopFit with = fitted(question, with_move(question, without.point, move, {0.6}), LoopSearch::a_look);
  ASSERT_FALSE(with.fit.failed);
  with.fit.parameters[4] = 0.1;
  for (double const exponent : {0.5, 0.85, 0.95, 1.0, 1.05, 1.5}) {
    with.fit.parameters[5] = exponent;
    EXPECT_EQ(is_at_bound(question, without, with, move), std::abs(exponent - 1.0) < 0.1) << exponent;
  }
}

}  // namespace loop_ladder_test
