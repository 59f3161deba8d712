// A joint in vector registers and the same joint tick by tick are one joint; with effects it is the joint by itself.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "engine/simulate/rollout/rollout.hpp"
#include "unit/rollout/loops.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace rollout_paths_test {

constexpr int samples = 1000;
constexpr double rate_hz = 1000.0;
constexpr PlainStart start{0.02, 0.3, 0.4};

PlainInputs inputs() {
  PlainInputs made;
  made.rate_hz = rate_hz;
  made.reference = waves(samples, rate_hz);
  for (int k = 0; k < samples; ++k) {
    made.outside.push_back(0.2 * std::sin(0.02 * k));
    made.enabled.push_back(k % 400 < 350 ? 1.0 : 0.0);
  }
  return made;
}

PlainJoint heavy_and_dry() {
  PlainJoint joint;
  joint.gravity_sin = 0.6;
  joint.gravity_cos = -0.2;
  joint.forward = 0.25;
  joint.backward = -0.35;
  joint.offset = 0.1;
  return joint;
}

PlainController controller() {
  PlainController made{"pid", 18.0, 25.0, 1.0};
  made.torque_delay_s = 0.0013;
  made.torque_lag_s = 0.002;
  made.back_emf = 0.1;
  made.limit = 3.0;
  return made;
}

double largest(Eigen::MatrixXd const& a, Eigen::MatrixXd const& b) { return (a - b).cwiseAbs().maxCoeff(); }

// the weight by its series (1e-11 of it), an encoder's half step times the loop's damping a sample
constexpr double same = 1e-8;

TEST(RolloutPaths, OfAnEncoderTooFineToSeeAreThoseWithoutOne) {
  for (int const ticks : {1, 3}) {
    PlainInputs in = inputs();
    in.ticks_per_sample = ticks;
    RolloutTrack const track = track_of(in, start);
    RolloutTrial const fast = trial_of(heavy_and_dry(), controller());
    RolloutTrial slow = fast;
    slow.encoder_step = 1e-12;
    Rolled const a = rolled(track, structure_of({}), {fast}), b = rolled(track, structure_of({}), {slow});
    EXPECT_LT(largest(a.position, b.position), same);
    EXPECT_LT(largest(a.velocity, b.velocity), 100.0 * same);
    EXPECT_LT(largest(a.torque, b.torque), 100.0 * same);
  }
}

// a sine is carried on for 256 ticks of d rad, for 16 of larger ones, and made anew at every tick beyond: d^6 / 720 of
// the weight each, 2e-8 at the most
TEST(RolloutPaths, CarryTheSineOfAWeightOn) {
  for (double const turn : {0.019, 0.09, 0.2}) {
    PlainInputs in;
    in.rate_hz = rate_hz;
    for (int k = 0; k < samples; ++k) in.reference.push_back(turn * k);
    PlainController cascade{"p_velocity", 12.0, 0.0, 0.0, 1.2};
    cascade.feed_speed = 1.0;
    PlainStart const moving{0.0, turn * rate_hz, 0.0};
    RolloutTrial const fast = trial_of(heavy_and_dry(), cascade);
    RolloutStructure by_ticks = structure_of({});
    by_ticks.effects = {find_effect("cogging")};
    RolloutTrial slow = fast;
    slow.effects = {{0.0, 0.0, 7.0}};
    RolloutTrack const track = track_of(in, moving);
    Rolled const a = rolled(track, structure_of({}), {fast}), b = rolled(track, by_ticks, {slow});
    // stiffness and inertia make less of it
    EXPECT_LT(largest(a.position, b.position), 0.2 * same) << turn;
    EXPECT_GT(a.position(samples - 1, 0), 0.9 * turn * samples);
  }
}

TEST(RolloutPaths, OfAnEffectOfNoSizeAreTheFastOne) {
  RolloutTrack const track = track_of(inputs(), start);
  RolloutTrial const fast = trial_of(heavy_and_dry(), controller());
  Rolled const a = rolled(track, structure_of({}), {fast});
  RolloutStructure structure = structure_of({});
  RolloutTrial slow = fast;
  structure.effects = {find_effect("cogging")};
  slow.effects = {{0.0, 0.0, 7.0}};
  Rolled const b = rolled(track, structure, {slow});
  EXPECT_LT(largest(a.position, b.position), same);
  EXPECT_LT(largest(a.torque, b.torque), 100.0 * same);
}

// a recording without a reference beside others that have one: their controller does not act on it
TEST(RolloutPaths, WithoutAReferenceKnowNoController) {
  RolloutTrack track = track_of(inputs(), start);
  track.drive = TrackDrive::torque;
  track.reference.resize(0);
  track.added = track.torque;
  RolloutTrial const led = trial_of(heavy_and_dry(), controller());
  RolloutTrial alone = led;
  alone.loop = numbers_of(LoopForm::none, {});
  alone.loop.back_emf = led.loop.back_emf;
  alone.loop.torque_delay_s = led.loop.torque_delay_s;
  alone.loop.torque_lag_s = led.loop.torque_lag_s;
  alone.loop.log_lag_s = led.loop.log_lag_s;
  Rolled const a = rolled(track, structure_of({}), {led}), b = rolled(track, structure_of({}), {alone});
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.torque, b.torque);
}

TEST(RolloutPaths, ReadByTheStepsOfAnEncoder) {
  constexpr double step = 1e-3;
  PlainInputs const in = inputs();
  PlainMotion const plain = PlainLoop(heavy_and_dry(), controller(), in, start, 100, step).run();
  RolloutTrial trial = trial_of(heavy_and_dry(), controller());
  trial.encoder_step = step;
  Rolled const all = rolled(track_of(in, start), structure_of({}), {trial});
  // the two may round a position to steps beside each other, for which the loop then makes up: a step of it each way
  Eigen::VectorXd const off = (all.position.col(0) - vector_of(plain.position)).cwiseAbs();
  EXPECT_LT(off.maxCoeff(), 2.5 * step);
  EXPECT_LT(off.mean(), 0.1 * step);
  for (Eigen::Index k = 0; k < samples; ++k) {
    double const steps = all.position(k, 0) / step;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
  }
  // elsewhere by a phase
  trial.encoder_phase = 0.25 * step;
  double const shifted = rolled(track_of(in, start), structure_of({}), {trial}).position(500, 0) / step;
  EXPECT_NEAR(shifted - std::floor(shifted), 0.75, 1e-9);
}

// an effect is held for a millisecond: second order, as the ticks
TEST(RolloutPaths, OfEffectsAreThoseOfTheJointByItself) {
  struct {
    std::string effect;
    std::vector<double> parameters;
    std::function<double(double, double)> smooth;
    std::function<double(double)> sliding;
  } const cases[] = {
      {"cogging",
       {0.2, -0.1, 9.0},
       [](double, double q) { return 0.2 * std::cos(9.0 * q) - 0.1 * std::sin(9.0 * q); },
       {}},
      {"stribeck", {0.3, 0.2, 2.0}, {}, [](double speed) { return 0.3 * std::exp(-std::pow(speed / 0.2, 2.0)); }},
  };
  for (auto const& [effect, parameters, smooth, sliding] : cases) {
    PlainJoint joint = heavy_and_dry();
    joint.smooth = smooth;
    joint.sliding = sliding;
    PlainMotion const plain = PlainLoop(joint, controller(), inputs(), start, 100).run();
    RolloutStructure structure = structure_of({});
    structure.effects = {find_effect(effect)};
    RolloutTrial trial = trial_of(heavy_and_dry(), controller());
    trial.effects = {parameters};
    Rolled const all = rolled(track_of(inputs(), start), structure, {trial});
    EXPECT_LT((all.position.col(0) - vector_of(plain.position)).cwiseAbs().maxCoeff(), 1e-4) << effect;
    EXPECT_LT((all.torque.col(0) - vector_of(plain.torque)).cwiseAbs().maxCoeff(), 2e-2) << effect;
    joint.smooth = {};
    joint.sliding = {};
    PlainMotion const without = PlainLoop(joint, controller(), inputs(), start, 20).run();
    EXPECT_GT((all.position.col(0) - vector_of(without.position)).cwiseAbs().maxCoeff(), 2e-3) << effect;
  }
}

// a controller in samples that says what a controller of numbers says: kp (r - q) - kd (q - q before) rate
TEST(RolloutPaths, OfAnIdentifiedControllerAreThoseOfItsController) {
  PlainController const pd{"pd", 18.0, 0.0, 1.0};
  PlainInputs in = inputs();
  in.enabled.clear();
  PlainMotion const plain = PlainLoop(heavy_and_dry(), pd, in, start, 100).run();
  RolloutTrack track = track_of(in, start);
  LoopController controller;
  controller.position = {-pd.kp - pd.kd * rate_hz, pd.kd * rate_hz};
  controller.reference = {0.0, pd.kp, 0.0};
  track.controller = controller;
  RolloutTrial trial = trial_of(heavy_and_dry(), pd);
  trial.loop = numbers_of(LoopForm::identified, {});
  Rolled const all = rolled(track, structure_of({}), {trial});
  EXPECT_LT((all.position.col(0) - vector_of(plain.position)).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((all.torque.col(0) - vector_of(plain.torque)).cwiseAbs().maxCoeff(), 2e-2);
}

// of trials whose effects differ, each is what it is alone
TEST(RolloutPaths, OfEffectsThatDifferByLaneAreThoseOfEachAlone) {
  RolloutTrack const track = track_of(inputs(), start);
  for (std::string const effect : {"cogging", "stribeck", "presliding", "load_dependent_friction"}) {
    RolloutStructure structure = structure_of({});
    structure.effects = {find_effect(effect)};
    structure.scales.inertia = 0.05;
    structure.scales.coulomb_positive = structure.scales.coulomb_negative = 0.3;
    auto const ranges = find_effect(effect)->shape_bounds(structure.scales);
    std::vector<RolloutTrial> trials;
    for (int lane = 0; lane < 8; ++lane) {
      trials.push_back(trial_of(heavy_and_dry(), controller()));
      trials.back().joint.inertia *= 1.0 + 0.05 * lane;
      std::vector<double> parameters;
      for (std::size_t k = 0; k < find_effect(effect)->n_linear(); ++k) parameters.push_back(0.03 * (1 + lane % 3));
      for (auto const& range : ranges)
        parameters.push_back(range.lower + (0.2 + 0.2 * (lane % 4)) * (range.upper - range.lower));
      trials.back().effects = {parameters};
    }
    Rolled const together = rolled(track, structure, trials);
    for (std::size_t lane = 0; lane < trials.size(); ++lane) {
      auto const column = static_cast<Eigen::Index>(lane);
      Rolled const alone = rolled(track, structure, {trials[lane]});
      EXPECT_TRUE(alone.position.allFinite()) << effect;
      EXPECT_TRUE(same_bits(together.position.col(column), alone.position)) << effect << lane;
      EXPECT_TRUE(same_bits(together.torque.col(column), alone.torque)) << effect << lane;
    }
  }
}

}  // namespace rollout_paths_test
