// Replicates of a recording.

#include "engine/simulate/replicate_simulator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/simulate/controller_fit.hpp"
#include "engine/simulate/joint_simulation.hpp"
#include "engine/simulate/tracking_controller.hpp"
#include "unit/simulate/plants.hpp"

using namespace torquescope;
using torquescope::test::plant;

namespace replicate_simulator_test {

constexpr double encoder_step = 2.0 * 3.14159265358979323846 / 400000.0;
std::vector<std::string> const terms{"inertia", "viscous", "coulomb", "offset", "gravity"};
Eigen::VectorXd truth() {
  Eigen::VectorXd values(6);
  values << 0.036, 0.164, 1.3, -0.125, 0.4, 0.2;
  return values;
}

SimulationPlan plan_of(std::string const& kind) {
  SimulationPlan plan;
  plan.simulation.rate_hz = 1000.0;
  plan.simulation.duration_s = 10.0;
  plan.plant = plant({{"inertia", 0.036},
                      {"viscous", 0.164},
                      {"coulomb", 1.3},
                      {"offset", -0.125},
                      {"gravity_sin", 0.4},
                      {"gravity_cos", 0.2}});
  plan.controller.kind = kind;
  plan.controller.bandwidth_hz = 8.0;
  plan.encoder.counts_per_revolution = 400000;
  plan.noise.torque_std = 0.02;
  return plan;
}

ReplicateTrack track_of(SimulatedRecording const& recording) {
  return {recording.rate_hz, recording.reference, recording.position[0], 0.0};
}

ReplicateSimulator replicate_of(SimulatedRecording const& recording, ReplicateJoint const& joint,
                                double step_s = 1e-4) {
  auto const fit = fit_controller({recording.time_s, recording.reference, recording.position, recording.torque});
  return {joint, {fit.controller, encoder_step, fit.noise}, track_of(recording), step_s};
}

ReplicateSimulator replicate_of(SimulatedRecording const& recording) {
  return replicate_of(recording, make_replicate_joint(Regressor(terms, JointKind::revolute), truth()));
}

double rms(Eigen::VectorXd const& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

class EveryReplicate : public testing::TestWithParam<std::string> {};

TEST_P(EveryReplicate, FollowsTheRecordedPositionToAboutOneEncoderStep) {
  auto const recording = simulate_joint(plan_of(GetParam()), 3);
  ReplicateGroup group;
  replicate_of(recording).simulate({1, 0, 0}, 0, group);
  for (std::size_t lane : {std::size_t{0}, replicate_lanes - 1}) {
    EXPECT_FALSE(group.ran_away[lane]);
    EXPECT_LT(rms(group.position[lane] - recording.position), encoder_step);
  }
}
INSTANTIATE_TEST_SUITE_P(Kinds, EveryReplicate, testing::Values("pd", "pid", "p_velocity"));

TEST(ReplicateSimulator, HasTheSameBitsWhateverWasSimulatedBefore) {
  auto const recording = simulate_joint(plan_of("pd"), 3);
  auto const replicate = replicate_of(recording);
  ReplicateGroup used, fresh;
  replicate.simulate({1, 0, 0}, 7, used);
  replicate.simulate({1, 0, 0}, 2, used);
  replicate.simulate({1, 0, 0}, 2, fresh);
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    EXPECT_EQ(used.position[lane], fresh.position[lane]);
    EXPECT_EQ(used.torque[lane], fresh.torque[lane]);
  }
}

TEST(ReplicateSimulator, HasNoiseOfItsOwnInEveryLaneGroupAndSet) {
  auto const recording = simulate_joint(plan_of("pd"), 3);
  auto const replicate = replicate_of(recording);
  ReplicateGroup group, next, other_set;
  replicate.simulate({1, 0, 0}, 0, group);
  replicate.simulate({1, 0, 0}, 1, next);
  replicate.simulate({1, 0, 1}, 0, other_set);
  Eigen::VectorXd const noise = group.torque[0] - recording.torque;
  auto const correlation = [&](Eigen::VectorXd const& torque) {
    Eigen::VectorXd const other = torque - recording.torque;
    return noise.dot(other) / (noise.norm() * other.norm());
  };
  // each difference holds the recording's own noise: 1/2; replicates that shared theirs would show 1
  for (auto const* torque : {&group.torque[1], &next.torque[0], &other_set.torque[0]})
    EXPECT_NEAR(correlation(*torque), 0.5, 0.1);
}

TEST(ReplicateSimulator, DrawsAStickingControllerForEveryLaneWhereItIsUnknown) {
  auto const recording = simulate_joint(plan_of("pd"), 3);
  auto const held = replicate_of(recording);
  ReplicateLoop loop = held.loop();
  loop.torque_noise = white(0.0);
  loop.encoder_step = 0.0;
  ReplicateSimulator const exact(held.joint(), loop, held.track(), held.step_s());
  loop.sticking = {1e-4, 2e-2, 3.0 * encoder_step};
  ReplicateSimulator const drawn(held.joint(), loop, held.track(), held.step_s());
  ReplicateGroup at_once, group, again;
  exact.simulate({1, 0, 0}, 3, at_once);
  drawn.simulate({1, 0, 0}, 3, group);
  drawn.simulate({1, 0, 0}, 3, again);
  double least = 1e9, most = 0.0;
  for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
    EXPECT_FALSE(group.ran_away[lane]);
    EXPECT_EQ(group.torque[lane], again.torque[lane]);
    double const apart = rms(group.torque[lane] - at_once.torque[lane]);
    least = std::min(least, apart);
    most = std::max(most, apart);
  }
  // a slow creep is nearly none, a fast one shows at every reversal
  EXPECT_GT(most, 5.0 * least);
  EXPECT_LT(least, 0.01 * 1.3);
}

TEST(ReplicateSimulator, IsTheSameWithATermInTheLanesOrAsAnEffect) {
  // viscous friction and weight as effects: evaluated at the foreseen middle of the step instead of inside it
  auto const recording = simulate_joint(plan_of("pd"), 3);
  ReplicateJoint const whole = make_replicate_joint(Regressor(terms, JointKind::revolute), truth());
  ReplicateJoint split = whole;
  split.lanes.viscous = split.lanes.gravity_sin = split.lanes.gravity_cos = 0.0;
  split.coulomb_forward -= 0.5;
  split.coulomb_backward += 0.5;
  split.effects = {lane_effect(*find_effect("viscous"), {0.164}, {}),
                   lane_effect(*find_effect("gravity"), {0.4, 0.2}, {}),
                   lane_effect(*find_effect("coulomb"), {0.5}, {})};
  ReplicateGroup one, two;
  replicate_of(recording, whole).simulate({1, 0, 0}, 0, one);
  replicate_of(recording, split).simulate({1, 0, 0}, 0, two);
  EXPECT_LT(rms(one.position[0] - two.position[0]), 0.5 * encoder_step);
}

// Large parts that cancel, as fits of a controller that is nearly another one have them, in a slow log: held for a tick
// of 10 ms the one would be late beside the other, and the joint would seem heavier
TEST(ReplicateSimulator, IsTheSameWithLargePartsThatCancel) {
  auto plan = plan_of("pd");
  plan.simulation.rate_hz = 100.0;
  plan.controller.bandwidth_hz = 2.0;
  auto const recording = simulate_joint(plan, 3);
  ReplicateJoint const whole = make_replicate_joint(Regressor(terms, JointKind::revolute), truth());
  ReplicateJoint split = whole;
  split.lanes.viscous -= 3.0;
  split.effects = {lane_effect(*find_effect("viscous"), {3.0}, {})};
  ReplicateGroup one, two;
  ReplicateSimulator const replicate = replicate_of(recording, whole);
  replicate.simulate({1, 0, 0}, 0, one);
  ReplicateSimulator(split, replicate.loop(), replicate.track(), 1e-4).simulate({1, 0, 0}, 0, two);
  // 0.025 were it held for the tick
  EXPECT_LT(rms(one.torque[0] - two.torque[0]), 0.002 * rms(one.torque[0]));
}

// a sensor that adds a constant
class Shifted final : public LaneEffect {
 public:
  Shifted(double position, double torque) : position_(position), torque_(torque) {}
  void shift_position(LaneInstant const&, double* position) override {
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) position[lane] += position_;
  }
  void shift_torque(LaneInstant const& at, double* torque) override {
    for (std::size_t lane = 0; lane < replicate_lanes; ++lane) {
      // called at the tick, with the command of this very tick
      EXPECT_NEAR(torque[lane], at.motor_torque[lane], 0.2);
      torque[lane] += torque_;
    }
  }

 private:
  double position_, torque_;
};

TEST(ReplicateSimulator, HoldsThePlainFormOfAControllerThatHasShapes) {
  auto const recording = simulate_joint(plan_of("pd"), 3);
  auto with_spring = std::vector<std::string>(terms.begin(), terms.end());
  with_spring.emplace_back("spring");
  Eigen::VectorXd parameters(truth().size() + 1);
  parameters << truth(), 0.3;
  ReplicateJoint apart = make_replicate_joint(Regressor(terms, JointKind::revolute), truth());
  apart.effects.push_back(lane_effect(*find_effect("spring"), {0.3, 0.0, 0.7}, {}));
  ReplicateGroup one, two;
  replicate_of(recording, make_replicate_joint(Regressor(with_spring, JointKind::revolute), parameters))
      .simulate({1, 0, 0}, 0, one);
  replicate_of(recording, apart).simulate({1, 0, 0}, 0, two);
  EXPECT_EQ(one.position[0], two.position[0]);
}

TEST(ReplicateSimulator, SeesAPositionFaultInTheLoopAndATorqueFaultInTheLogOnly) {
  auto const recording = simulate_joint(plan_of("pd"), 3);
  ReplicateJoint const sound = make_replicate_joint(Regressor(terms, JointKind::revolute), truth());
  auto const group_with = [&](double position, double torque) {
    ReplicateJoint joint = sound;
    joint.effects = {[=] { return std::make_unique<Shifted>(position, torque); }};
    ReplicateGroup group;
    replicate_of(recording, joint).simulate({1, 0, 0}, 0, group);
    return group;
  };
  auto const none = group_with(0.0, 0.0), torque = group_with(0.0, 0.3), position = group_with(0.01, 0.0);
  EXPECT_EQ(torque.position[0], none.position[0]);
  EXPECT_LT((torque.torque[0] - none.torque[0]).array().abs().maxCoeff(), 0.3 + 1e-12);
  EXPECT_GT((torque.torque[0] - none.torque[0]).array().abs().minCoeff(), 0.3 - 1e-12);
  // the loop moves the joint until the faulty reading is where the reference is: what is measured hardly changes
  EXPECT_LT(rms(position.position[0] - none.position[0]), 0.001);
  EXPECT_GT(rms(position.torque[0] - none.torque[0]), 0.001);
}

// a joint alone takes a step per tick; beside a controller with a memory, here one that gives nothing, it takes fifty
TEST(ReplicateSimulator, DoesNotDependOnItsStep) {
  for (double rate_hz : {1000.0, 200.0}) {
    SimulationPlan plan = plan_of("pd");
    plan.simulation.rate_hz = rate_hz;
    plan.controller.bandwidth_hz = 0.008 * rate_hz;
    auto const recording = simulate_joint(plan, 3);
    ReplicateJoint const alone = make_replicate_joint(Regressor(terms, JointKind::revolute), truth());
    ReplicateJoint beside = alone;
    beside.effects = {[] { return std::make_unique<Shifted>(0.0, 0.0); }};
    ReplicateGroup coarse, fine;
    replicate_of(recording, alone).simulate({1, 0, 0}, 0, coarse);
    replicate_of(recording, beside, 2e-5).simulate({1, 0, 0}, 0, fine);
    // encoder and loop make one step of the least differences: below one step all the same
    EXPECT_LT(rms(coarse.position[0] - fine.position[0]), 0.5 * encoder_step) << rate_hz;
  }
}

// of an arm: what the controller gives to the other joints does not move this one, and is not in its torque
TEST(ReplicateSimulator, GivesOtherJointsTheirLoadBesideItsOwnTorque) {
  auto const recording = simulate_joint(plan_of("pd"), 3);
  ReplicateSimulator const alone = replicate_of(recording);
  ReplicateLoop loop = alone.loop();
  ReplicateTrack track = alone.track();
  track.gear_load = 5.0 * (3.0 * recording.time_s.array()).sin();
  loop.controller.gear_load = {1.0, 0.0};
  ReplicateGroup plain, beside, unfed;
  alone.simulate({1, 0, 0}, 0, plain);
  ReplicateSimulator(alone.joint(), loop, track, 1e-4).simulate({1, 0, 0}, 0, beside);
  EXPECT_LT((beside.torque[0] - plain.torque[0]).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((beside.position[0] - plain.position[0]).cwiseAbs().maxCoeff(), 1.01 * encoder_step);
  // a controller that does not feed it forward lets the joint give way to it
  loop.controller.gear_load = {0.0, 0.0};
  ReplicateSimulator(alone.joint(), loop, track, 1e-4).simulate({1, 0, 0}, 0, unfed);
  EXPECT_GT(rms(unfed.position[0] - plain.position[0]), 100.0 * encoder_step);
  // what runs away is the torque of the drive
  track.largest_torque = 6.0;
  loop.controller.gear_load = {1.0, 0.0};
  track.gear_load.setConstant(100.0);
  ReplicateSimulator(alone.joint(), loop, track, 1e-4).simulate({1, 0, 0}, 0, beside);
  EXPECT_TRUE(beside.ran_away[0]);
}

TEST(ReplicateSimulator, SaysThatItRanAway) {
  auto const recording = simulate_joint(plan_of("pd"), 3);
  ReplicateJoint const joint = make_replicate_joint(Regressor(terms, JointKind::revolute), truth());
  auto const sound = replicate_of(recording);
  ReplicateLoop loop = sound.loop();
  for (auto& gain : loop.controller.position) gain *= -1.0;
  ReplicateTrack track = sound.track();
  track.largest_torque = 3.0 * recording.torque.cwiseAbs().maxCoeff();
  ReplicateGroup group;
  ReplicateSimulator(joint, loop, track, 1e-4).simulate({1, 0, 0}, 0, group);
  for (bool one : group.ran_away) EXPECT_TRUE(one);
}

TEST(TrackingController, FollowsAMotionThatHasNoReference) {
  auto const recording = simulate_joint(plan_of("pd"), 3);
  ReplicateJoint const joint = make_replicate_joint(Regressor(terms, JointKind::revolute), truth());
  ReplicateTrack track = track_of(recording);
  track.reference = recording.true_position;
  ReplicateSimulator const replicate(
      joint, {tracking_controller({joint.lanes.inertia}, 30.0, {1000.0}), encoder_step, white(0.02)}, track, 1e-4);
  ReplicateGroup group;
  replicate.simulate({1, 0, 0}, 0, group);
  // friction of 1.3 N m over a stiffness of J omega^2 = 1280 N m/rad
  double const by_error = rms(group.position[0] - recording.position);
  double const torque_by_error = rms(group.torque[0] - recording.torque);
  EXPECT_LT(by_error, 2.0 * 1.3 / 1280.0);
  // a controller that knows friction and gravity need not learn of them by its error, nor fight at reversals what is in
  // the motion
  auto const& lanes = joint.lanes;
  TrackedJoint const known{
      lanes.inertia,     lanes.viscous,    joint.coulomb_forward + joint.offset, joint.coulomb_backward + joint.offset,
      lanes.gravity_sin, lanes.gravity_cos};
  ReplicateSimulator(joint, {tracking_controller(known, 30.0, {1000.0, 1e-3}), encoder_step, white(0.02)}, track, 1e-4)
      .simulate({1, 0, 0}, 0, group);
  EXPECT_LT(rms(group.position[0] - recording.position), 0.1 * by_error);
  EXPECT_LT(rms(group.torque[0] - recording.torque), 0.7 * torque_by_error);
}

TEST(ReplicateSimulator, FeedsForwardWhatItsControllerSays) {
  auto const recording = simulate_joint(plan_of("pd"), 3);
  auto const plain = replicate_of(recording);
  ReplicateLoop quiet = plain.loop();
  quiet.torque_noise = quiet.slow_torque_noise = white(0.0);
  quiet.disturbance_std = quiet.position_noise_std = quiet.friction_wander = quiet.encoder_step = 0.0;
  quiet.controller.position.assign(1, 0.0);
  quiet.controller.reference.clear();
  quiet.controller.integral = quiet.controller.constant = 0.0;
  double const friction = 0.6, width = 1e-4, gravity = 0.3;
  quiet.controller.terms = {{ReferenceShape::smooth_sign, 0, 2, width, friction},
                            {ReferenceShape::cosine, 1, 1, 1.0, gravity}};
  ReplicateGroup group;
  ReplicateSimulator(plain.joint(), quiet, plain.track(), 1e-4).simulate({1, 0, 0}, 0, group);
  auto const& r = recording.reference;
  for (Eigen::Index k = 2; k + 1 < r.size(); k += 97)
    EXPECT_DOUBLE_EQ(group.torque[0][k],
                     friction * std::tanh(0.5 * (r[k] - r[k - 2]) / width) + gravity * std::cos(r[k + 1]));
}

}  // namespace replicate_simulator_test
