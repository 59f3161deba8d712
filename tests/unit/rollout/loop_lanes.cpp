// Every number of a loop does in the lanes what it does in a joint that is simulated by itself, a hundred steps a tick.

#include "engine/simulate/rollout/loop_lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "unit/rollout/loops.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace loop_lanes_test {

// A tick h is a step of second order: h^2 / 6 of what the acceleration changes by in a second, and h^2 / 8 of an
// acceleration where a torque that changes within the tick acts by its mean: 1e-6 rad at 1 ms, some times that in a
// loop that rings. A tick more of delay is a hundred times as much
constexpr double near = 2e-5;
constexpr double velocity_for_position = 100.0, torque_for_position = 200.0;  // 1/s; gains of the loops
constexpr int samples = 1400, fine_steps = 100;
constexpr double rate_hz = 1000.0;

struct Case {
  std::string name;
  std::function<void(PlainJoint&, PlainController&, PlainInputs&)> change;
  double tolerance = near;
};

PlainController controller_of(std::string const& form) {
  PlainController controller;
  controller.form = form;
  bool const is_cascade = form == "p_velocity" || form == "p_pi";
  controller.kp = is_cascade ? 12.0 : form == "pi" || form == "p" ? 4.0 : 18.0;
  controller.kd = 1.1;
  controller.kv = 1.2;
  controller.ki = form == "p_pi" ? 9.0 : form == "pi" ? 3.0 : 30.0;
  return controller;
}

double largest(Eigen::VectorXd const& simulated, std::vector<double> const& plain) {
  return (simulated - vector_of(plain)).cwiseAbs().maxCoeff();
}

// in a lane beside another joint
void expect_alike(PlainJoint const& joint, PlainController const& controller, PlainInputs const& inputs,
                  double tolerance, std::string const& name) {
  PlainStart const start{0.02, 0.3, 0.4};
  PlainMotion const plain = PlainLoop(joint, controller, inputs, start, fine_steps).run();
  RolloutTrack const track = track_of(inputs, start);
  RolloutTrial const trial = trial_of(joint, controller);
  RolloutTrial other = trial;
  other.joint.inertia *= 1.3;
  double const step_s = longest_step_s(trial, {}, track.tick_s());
  auto const all = rolled(track, structure_of(controller, step_s), {other, trial});
  double const range = track.position.maxCoeff() - track.position.minCoeff();
  ASSERT_GT(range, 0.3) << name;
  auto const at_limit = [&](double torque) { return std::abs(torque) == controller.limit; };
  auto const limited = std::count_if(plain.torque.begin(), plain.torque.end(), at_limit);
  EXPECT_GE(limited, std::isfinite(controller.limit) ? samples / 20 : 0) << name;
  EXPECT_LT(largest(all.position.col(1), plain.position), tolerance) << name;
  EXPECT_LT(largest(all.velocity.col(1), plain.velocity), velocity_for_position * tolerance) << name;
  EXPECT_LT(largest(all.torque.col(1), plain.torque), torque_for_position * tolerance) << name;
}

std::vector<std::string> const forms{"p", "pi", "pd", "pid", "p_velocity", "p_pi"};

void expect_alike_in_all_forms(std::vector<Case> const& cases) {
  for (auto const& form : forms)
    for (auto const& one : cases) {
      PlainJoint joint;
      PlainController controller = controller_of(form);
      PlainInputs inputs;
      inputs.rate_hz = rate_hz;
      inputs.reference = waves(samples, rate_hz);
      one.change(joint, controller, inputs);
      expect_alike(joint, controller, inputs, one.tolerance, form + ", " + one.name);
    }
}

TEST(LoopLanes, AnswerAsEveryFormIsWritten) {
  expect_alike_in_all_forms({
      {"as it is", [](auto&, auto&, auto&) {}},
      {"over two samples", [](auto&, PlainController& c, auto&) { c.span = 2; }},
      {"of the joint's own speed", [](auto&, PlainController& c, auto&) { c.span = 0; }},
      {"with a lag of the speed", [](auto&, PlainController& c, auto&) { c.speed_lag_s = 0.011; }},
      {"with speed fed forward", [](auto&, PlainController& c, auto&) { c.feed_speed = 0.8; }},
      {"with acceleration fed forward", [](auto&, PlainController& c, auto&) { c.feed_acceleration = 0.04; }},
      {"at a limit", [](auto&, PlainController& c, auto&) { c.limit = 0.7; }},
  });
}

// a held command changes at ticks only, and a delay of whole ticks moves nothing within one
TEST(LoopLanes, DelayByWholeAndByPartsOfTicks) {
  expect_alike_in_all_forms({
      {"command three ticks late", [](auto&, PlainController& c, auto&) { c.command_delay_s = 0.003; }},
      {"command late by parts of ticks",
       [](auto&, PlainController& c, PlainInputs& in) {
         c.command_delay_s = 0.0067;
         in.straight = true;
       }},
      {"torque a tick late", [](auto&, PlainController& c, auto&) { c.torque_delay_s = 0.001; }},
      {"torque late by parts of ticks", [](auto&, PlainController& c, auto&) { c.torque_delay_s = 0.0026; }},
      {"torque lagging", [](auto&, PlainController& c, auto&) { c.torque_lag_s = 0.005; }},
      {"log lagging", [](auto&, PlainController& c, auto&) { c.log_lag_s = 0.009; }},
  });
}

TEST(LoopLanes, AnswerWhatComesFromOutside) {
  auto const wave = [](double size, double rate) {
    std::vector<double> values;
    for (int k = 0; k < samples; ++k) values.push_back(size * std::sin(rate * k));
    return values;
  };
  expect_alike_in_all_forms({
      {"added command",
       [&](auto&, PlainController& c, PlainInputs& in) {
         c.added_gain = 0.6;
         in.added = wave(0.5, 0.03);
       }},
      {"torque from outside", [&](auto&, auto&, PlainInputs& in) { in.outside = wave(0.4, 0.05); }},
      {"a motor voltage that is switched off now and then",
       [&](auto&, PlainController& c, PlainInputs& in) {
         c.back_emf = 0.2;
         for (int k = 0; k < samples; ++k) in.enabled.push_back(k % 300 < 240 ? 1.0 : 0.0);
       }},
      {"an offset", [](PlainJoint& joint, auto&, auto&) { joint.offset = 0.35; }},
  });
}

TEST(LoopLanes, TickFasterAndSlowerThanTheSamples) {
  expect_alike_in_all_forms({
      {"a controller of every third tick", [](auto&, PlainController& c, auto&) { c.hold = 3; }},
      {"every third tick over two of its samples, late and lagging",
       [](auto&, PlainController& c, auto&) {
         c.hold = 3;
         c.span = 2;
         c.speed_lag_s = 0.01;
         c.torque_delay_s = 0.002;
         c.feed_speed = 0.5;
       }},
      {"four ticks a sample, held", [](auto&, auto&, PlainInputs& in) { in.ticks_per_sample = 4; }},
      {"four ticks a sample, straight",
       [](auto&, PlainController& c, PlainInputs& in) {
         in.ticks_per_sample = 4;
         in.straight = true;
         c.feed_speed = 1.0;
         c.command_delay_s = 0.0031;
       }},
  });
}

TEST(LoopLanes, CarryAWeightAndStickInFriction) {
  // dry friction makes a motion that stops a tick earlier or later: its acceleration times half of a tick squared
  constexpr double of_stops = 1e-4;
  expect_alike_in_all_forms({
      {"weight",
       [](PlainJoint& joint, auto&, auto&) {
         joint.gravity_sin = 0.9;
         joint.gravity_cos = -0.4;
       }},
      {"friction alone",
       [](PlainJoint& joint, auto&, auto&) {
         joint.forward = 0.5;
         joint.backward = -0.3;
       },
       of_stops},
      {"friction and weight",
       [](PlainJoint& joint, auto&, auto&) {
         joint.gravity_sin = 0.7;
         joint.gravity_cos = 0.3;
         joint.forward = 0.4;
         joint.backward = -0.6;
       },
       of_stops},
  });
}

TEST(LoopLanes, StickWhereTheJointByItselfSticks) {
  PlainJoint joint;
  joint.forward = 0.6;
  joint.backward = -0.4;
  PlainController const controller = controller_of("p");
  PlainInputs inputs;
  inputs.rate_hz = rate_hz;
  inputs.reference = waves(samples, rate_hz, 0.5);
  PlainMotion const plain = PlainLoop(joint, controller, inputs, {}, fine_steps).run();
  auto const all = rolled(track_of(inputs, {}), structure_of(controller), {trial_of(joint, controller)});
  int stuck = 0, apart = 0;
  for (int k = 0; k < samples; ++k) {
    bool const sticks = plain.velocity[static_cast<std::size_t>(k)] == 0.0;
    stuck += sticks ? 1 : 0;
    apart += sticks != (all.velocity(k, 0) == 0.0) ? 1 : 0;
  }
  EXPECT_GT(stuck, samples / 10);
  EXPECT_LE(apart, samples / 100);  // a stop may fall into the tick beside
}

// a weight that a joint turns through: within a tick its series leaves (turn a tick)^4 / 24 of it, 2e-5 at the most,
// and what is carried on from tick to tick less. Ticks of 2 ms
TEST(LoopLanes, TurnThroughAWeightAtAnySpeed) {
  for (double const turn : {0.01, 0.06, 0.15}) {  // rad a tick: carried on, carried on shortly, made anew
    PlainInputs inputs;
    for (int k = 0; k < 400; ++k) inputs.reference.push_back(turn * k);
    PlainJoint joint;
    joint.gravity_sin = 1.2;
    joint.gravity_cos = 0.5;
    PlainController controller = controller_of("p_velocity");
    controller.feed_speed = 1.0;
    PlainStart const start{0.0, turn * inputs.rate_hz, 0.0};
    PlainMotion const plain = PlainLoop(joint, controller, inputs, start, fine_steps).run();
    auto const all = rolled(track_of(inputs, start), structure_of(controller), {trial_of(joint, controller)});
    EXPECT_LT(largest(all.position.col(0), plain.position), 2.0 * near) << turn;
    EXPECT_GT(plain.position.back(), 300.0 * turn);
  }
}

// second order: half of the tick leaves a quarter
TEST(LoopLanes, AreOfSecondOrderInTheirSteps) {
  PlainJoint joint;
  joint.viscous = 1.0;
  joint.gravity_sin = 0.9;
  PlainController const controller = controller_of("pd");
  PlainInputs inputs;
  inputs.reference = waves(samples, inputs.rate_hz);
  PlainMotion const plain = PlainLoop(joint, controller, inputs, {}, fine_steps).run();
  auto const error = [&](double step_s) {
    auto const all = rolled(track_of(inputs, {}), structure_of(controller, step_s), {trial_of(joint, controller)});
    return largest(all.position.col(0), plain.position);
  };
  EXPECT_GT(error(2e-3) / error(5e-4), 10.0);  // 16 in theory
}

}  // namespace loop_lanes_test
