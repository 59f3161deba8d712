// What runs by a clock, or happens at an instant, is found again in another recording: at its own phase and time.

#include "engine/infer/decision/own_clock.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/infer/decision/fitted_model.hpp"
#include "unit/decision/plants.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace own_clock_test {

using Timed = std::function<double(double t, double q)>;

Timed wave(double size, double phase) {
  return [=](double t, double) { return size * std::sin(2.0 * std::numbers::pi * 1.7 * t + phase); };
}

Timed load_from(double instant_s) {
  return [=](double t, double q) { return t >= instant_s ? 0.5 * std::sin(q) + 0.2 * std::cos(q) : 0.0; };
}

struct Elsewhere {
  double without = 0.0, with = 0.0;  // validation errors
};

// a joint with one such torque in training and another in the recording to predict
Elsewhere predicted_elsewhere(Timed const& in_training, Timed const& elsewhere, ShapedEffect const& effect) {
  GivenJoint joint;
  joint.timed = in_training;
  std::vector<Recording> const training{recording_of(joint)};
  joint.timed = elsewhere;
  joint.pace = 0.87;
  joint.seed = 2;
  std::vector<Recording> const validation{recording_of(joint)};
  Regressor const terms = joint_terms();
  FilterOptions const filter = ten_hertz();
  Section const section{};
  JointStrips const rows = joint_strips({training, validation, terms, filter, section});
  DelayChoice const delay{DelaySearch::everywhere, 0.15};
  FittedModel const plain = fitted_model(rows, terms, {}, nullptr, delay);
  FittedModel const named = fitted_model(rows, terms, {effect}, plain.fitted.get(), delay);
  EXPECT_LT(errors_of(rows, named).train, 0.3 * errors_of(rows, plain).train);
  return {validation_error(rows, plain), validation_error(rows, named)};
}

TEST(OwnClock, AWaveHasAnotherPhaseElsewhere) {
  ShapedEffect const effect{find_effect("periodic_disturbance"), {1.7}};
  auto const [without, with] = predicted_elsewhere(wave(0.3, 0.3), wave(0.3, 2.1), effect);
  EXPECT_LT(with, 0.3 * without);
}

TEST(OwnClock, AWaveThatDoesNotRunElsewhereRaisesNothing) {
  ShapedEffect const effect{find_effect("periodic_disturbance"), {1.7}};
  auto const [without, with] = predicted_elsewhere(wave(0.3, 0.3), {}, effect);
  EXPECT_LE(with, without);
}

TEST(OwnClock, ALoadIsPickedUpAtAnotherInstantElsewhere) {
  ShapedEffect const effect{find_effect("payload_change"), {8.0}};
  auto const [without, with] = predicted_elsewhere(load_from(8.0), load_from(13.0), effect);
  EXPECT_LT(with, 0.3 * without);
}

TEST(OwnClock, AnEventThatDoesNotHappenElsewhereRaisesNothing) {
  ShapedEffect const effect{find_effect("payload_change"), {8.0}};
  auto const [without, with] = predicted_elsewhere(load_from(8.0), {}, effect);
  EXPECT_LE(with, without);
}

}  // namespace own_clock_test
