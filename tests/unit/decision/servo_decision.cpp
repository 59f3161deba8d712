// Records of a servo under two loads, simulated here by itself: a delay of the command and friction of the load that
// were put in are found with their numbers, and of a servo that has nothing else nothing is said.

#include "engine/infer/decision/servo_decision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "engine/infer/decision/servo_spread.hpp"
#include "unit/rollout/servos.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace servo_decision_test {

constexpr double rate_hz = 100.0, encoder_step = 2.0 * std::numbers::pi / 4096.0;
constexpr int samples = 300, ticks_per_sample = 5;
constexpr double own_inertia = 0.022, length = 0.15, volts_per_rad = 45.0, limit = 12.0;

struct Planted {
  double delay_s = 0.0, load = 0.0;
};

RolloutTrack recorded(Planted const& planted, double mass, double pace) {
  PlainServo servo;
  servo.inertia = own_inertia + mass * length * length;
  servo.weight = 9.80665 * mass * length;
  servo.gain = volts_per_rad;
  servo.limit = limit;
  servo.command_delay_s = planted.delay_s;
  servo.load = planted.load;
  servo.encoder_step = encoder_step;
  PlainInputs in;
  in.rate_hz = rate_hz;
  in.ticks_per_sample = ticks_per_sample;
  in.reference = servo_goals(samples, rate_hz, pace);
  // off for a while, so that the joint's own damping is told from the drive's
  for (int k = 0; k < samples; ++k) in.enabled.push_back(k < 240 ? 1.0 : 0.0);
  // at rest where the drive holds it
  PlainStart const start{encoder_step * std::round(0.05 / encoder_step), 0.0, 0.0};
  PlainMotion motion;
  motion.position = run_servo(servo, in, start).position;
  RolloutTrack track = track_of(in, start, motion);
  track.segments[0].torque = std::nan("");
  track.encoder_step = encoder_step;
  track.known = {servo.weight, mass * length * length, volts_per_rad, limit, length, std::nan("")};
  return track;
}

// four records to fit, under two loads, and two to judge by
struct Asked {
  Regressor terms{{"inertia", "viscous", "coulomb"}, JointKind::revolute};
  std::vector<RolloutTrack> training, validation;
  int threads = 1;
  std::size_t most_effects = 8;

  explicit Asked(Planted const& planted) {
    for (double const mass : {0.5, 1.0}) {
      for (double const pace : {0.8, 1.2}) training.push_back(recorded(planted, mass, pace));
      validation.push_back(recorded(planted, mass, 1.0));
    }
  }

  ServoQuestion question() const {
    LoopSetting loop;
    loop.form = LoopForm::p;
    loop.values[LoopKey::kp] = 1.0;
    ServoQuestion asked{terms, loop, DriveCommand::voltage, training, validation};
    asked.effects.of_drive.assign(drive_effects().begin(), drive_effects().end());
    asked.seed = 3;
    asked.threads = threads;
    asked.most_effects = most_effects;
    return asked;
  }
};

std::vector<std::string> names_of(LoopFacts const& facts) {
  std::vector<std::string> names;
  for (auto const& move : facts.kept) names.push_back(name_of(move.subject));
  std::sort(names.begin(), names.end());
  return names;
}

double value_of(std::vector<LoopNumber> const& numbers, std::string const& name) {
  for (auto const& one : numbers)
    if (one.name == name) return one.value;
  return std::nan("");
}

using Names = std::vector<std::string>;

Asked const& with_both() {
  static Asked const asked({.delay_s = 0.03, .load = 0.2});
  return asked;
}

ServoDecision const& decided_with_both() {
  static ServoDecision const decision = decide_servo(with_both().question());
  return decision;
}

TEST(ServoDecision, FindsADelayOfTheCommandAndFrictionOfTheLoad) {
  Asked const& asked = with_both();
  ServoDecision const& decision = decided_with_both();
  ASSERT_EQ(decision.facts.reason, LoopReason::decides);
  EXPECT_TRUE(decision.fixes_scale);
  ASSERT_EQ(names_of(decision.facts), (Names{"command_delay", "load_friction"}));
  auto const numbers = numbers_of_fit(asked.question(), decision, decision.final);
  EXPECT_NEAR(value_of(numbers, "loop_command_delay_s"), 0.03, 0.01 * 0.03);
  EXPECT_NEAR(value_of(numbers, "loop_load_friction"), 0.2, 0.03 * 0.2);
  // and with them the numbers of the servo itself
  PlainServo const servo;
  EXPECT_NEAR(value_of(numbers, "loop_motor_gain"), servo.motor_gain, 0.02 * servo.motor_gain);
  EXPECT_NEAR(value_of(numbers, "loop_back_emf"), servo.back_emf, 0.05 * servo.back_emf);
  EXPECT_NEAR(value_of(numbers, "inertia"), own_inertia, 0.05 * own_inertia);
  EXPECT_NEAR(value_of(numbers, "coulomb"), servo.coulomb, 0.05 * servo.coulomb);
  EXPECT_LT(decision.final.validation.position, 0.1 * decision.base.validation.position);
  EXPECT_EQ(servo_verdict(decision.facts, servo_fit(asked.question(), decision)), Verdict::named);
}

// The square of the load stands in for the load: no model of both of them is kept, and none that was asked predicts
// validation better by least_fall than what is kept
TEST(ServoDecision, KeepsNoEffectThatAnotherMakesUseless) {
  LoopFacts const& facts = decided_with_both().facts;
  double least_validation = 1.0;
  for (auto const& step : facts.steps)
    for (auto const& move : step.moves)
      if (move.refusal == MoveRefusal::none) least_validation = std::min(least_validation, move.after.both());
  EXPECT_EQ(facts.kept.size(), 2u);
  double const least_fall = with_both().question().numbers.least_fall;
  EXPECT_LE((1.0 - least_fall) * facts.final_validation.both(), least_validation);
  for (auto const& move : facts.kept) EXPECT_GT(move.gain, 100.0) << name_of(move.subject);
}

TEST(ServoDecision, SaysNothingOfAServoThatHasNothingElse) {
  Asked const asked({});
  ServoDecision const decision = decide_servo(asked.question());
  ASSERT_EQ(decision.facts.reason, LoopReason::decides);
  EXPECT_EQ(names_of(decision.facts), Names{});
  ServoFit const fit = servo_fit(asked.question(), decision);
  EXPECT_EQ(servo_verdict(decision.facts, fit), Verdict::none);
  EXPECT_GT(fit.replicates_rms, 0.1 * encoder_step);
  // one fit of the same structure without the heavy load predicts it all the same
  std::vector<RolloutTrack> const light(asked.training.begin(), asked.training.begin() + 2), none;
  ServoQuestion const all = asked.question();
  ServoQuestion const some{all.regressor, all.loop, all.command, light, none};
  LoopFit const fitted_anew = refitted(some, decision, decision.base);
  auto const numbers = numbers_of_fit(some, decision, fitted_anew);
  EXPECT_NEAR(value_of(numbers, "loop_motor_gain"), PlainServo{}.motor_gain, 0.02 * PlainServo{}.motor_gain);
}

// every number of the facts and of the fit
std::vector<double> numbers_in(ServoDecision const& decision) {
  LoopFacts const& facts = decision.facts;
  std::vector<double> all{facts.final_train.position, facts.final_validation.position, decision.final.fit.objective};
  for (auto const& step : facts.steps)
    for (auto const& move : step.moves) all.insert(all.end(), {move.gain, move.p, move.level});
  for (auto const& one : facts.numbers) all.insert(all.end(), {one.value, one.lower, one.upper});
  return all;
}

TEST(ServoDecision, IsTheSameOnTwoThreads) {
  Asked asked({.delay_s = 0.03});
  asked.most_effects = 1;
  auto const one = numbers_in(decide_servo(asked.question()));
  asked.threads = 2;
  auto const two = numbers_in(decide_servo(asked.question()));
  ASSERT_EQ(one.size(), two.size());
  EXPECT_EQ(std::memcmp(one.data(), two.data(), one.size() * sizeof(double)), 0);
}

}  // namespace servo_decision_test
