// A recording against the user's simulator: wrong parameters apart from missing physics, and what both hold cancels.

#include "engine/infer/pipeline/simulator_gap.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/infer/pipeline/held_torque.hpp"
#include "support/decompositions.hpp"
#include "unit/pipeline/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace simulator_gap_test {

// the motion as the user's own program makes it out of the recording: another filter than the job's
Motion users_motion(Recording const& recording) {
  FilterOptions options;
  options.cutoff_hz = 50.0;
  return differentiate(recording, options, {});
}

Eigen::VectorXd stribeck(Motion const& motion, double level) {
  return level * (motion.dq.array().sign() * (-(motion.dq.array() / 0.6).abs()).exp()).matrix();
}

Eigen::VectorXd simulator(Motion const& motion, Eigen::VectorXd const& parameters) {
  return clean_regressor().columns(motion) * parameters;
}

struct Bench {
  Recording recording;
  Motion motion;
  Eigen::VectorXd truth;
};

Bench bench() {
  auto const joint = clean_joint();
  Bench made{recorded(simulate_joint(joint.plan, 31)), {}, joint.truth};
  made.motion = users_motion(made.recording);
  return made;
}

Eigen::VectorXd residual_of(Recording const& recording) {
  return clean_pipeline(recording).process(recording).residual;
}

TEST(SimulatorGap, LeavesTheResidualOfTheDifferenceAndTheParametersOfTheJoint) {
  auto [recording, motion, truth] = bench();
  recording.torque += 0.05 * recording.position;  // missing physics: a spring
  Eigen::VectorXd const wrong = truth.cwiseProduct(Eigen::Vector4d(0.95, 1.05, 0.95, 1.0));
  recording.simulated_torque = simulator(motion, wrong) + stribeck(motion, 0.2);
  auto const pipeline = clean_pipeline(recording);
  auto const gap = gap_to_simulator(recording, pipeline);
  EXPECT_EQ(gap.recording.simulated_torque.size(), 0);

  Recording difference = recording;
  difference.torque -= torque_to_hold(recording.simulated_torque);
  auto const of_gap = pipeline.process(gap.recording);
  // what two joints differ by is none itself: its parameters have no bounds
  auto const of_difference = pipeline.prepare(difference);
  Eigen::VectorXd const errors = test::least_squares(of_difference.columns, of_difference.torque);
  Eigen::VectorXd const left = of_difference.torque - of_difference.columns * errors;
  // what the filter carries over from bridged reversals: below a thousandth of the Coulomb friction that turns round
  // there
  double const leak = (of_gap.residual - left).norm() / std::sqrt(of_gap.residual.size());
  EXPECT_LT(leak, 1e-3 * truth[2]);
  auto const of_joint = pipeline.process(recording);
  Eigen::ArrayXd const shift = (of_gap.parameters - of_joint.parameters).array() / of_joint.parameters.array();
  EXPECT_LT(shift.abs().maxCoeff(), 1e-3);
  EXPECT_LT((errors + gap.parameter_errors).norm(), 1e-9);
}

TEST(SimulatorGap, SaysWhichParametersOfTheSimulatorAreWrong) {
  auto [recording, motion, truth] = bench();
  Eigen::VectorXd const wrong = truth.cwiseProduct(Eigen::Vector4d(0.95, 1.05, 0.95, 1.0));
  recording.simulated_torque = simulator(motion, wrong);
  auto const gap = gap_to_simulator(recording, clean_pipeline(recording));
  // the simulator's own parameters, whatever the noise of the real torque; what is left are two filters for one motion
  EXPECT_LT(((gap.simulator_parameters - wrong).array() / truth.array()).abs().maxCoeff(), 2e-3);
  // against the joint's: bias of least squares from one noisy record (1 % of the viscous friction here)
  EXPECT_LT(((gap.parameter_errors - (wrong - truth)).array() / truth.array()).abs().maxCoeff(), 0.02);
  EXPECT_GT(gap.parameter_share, 0.5);
  EXPECT_LT(gap.beyond_rms, 0.003);
}

TEST(SimulatorGap, PhysicsThatBothHaveCancels) {
  auto [recording, motion, truth] = bench();
  double const noise = residual_of(recording).norm();
  recording.torque += stribeck(motion, 0.2);
  double const missing = residual_of(recording).norm();
  ASSERT_GT(missing, 2.0 * noise);

  // the simulator knows of it: nothing but noise is left; it does not: everything is left
  recording.simulated_torque = simulator(motion, truth) + stribeck(motion, 0.2);
  EXPECT_NEAR(residual_of(gap_to_simulator(recording, clean_pipeline(recording)).recording).norm() / noise, 1.0, 0.05);
  recording.simulated_torque = simulator(motion, truth);
  EXPECT_NEAR(residual_of(gap_to_simulator(recording, clean_pipeline(recording)).recording).norm() / missing, 1.0,
              0.05);
}

TEST(SimulatorGap, ASimulatorWithPhysicsTheJointLacksShowsToo) {
  auto [recording, motion, truth] = bench();
  double const noise = residual_of(recording).norm();
  recording.simulated_torque = simulator(motion, truth) + stribeck(motion, 0.2);
  auto const gap = gap_to_simulator(recording, clean_pipeline(recording));
  EXPECT_GT(residual_of(gap.recording).norm(), 2.0 * noise);
  EXPECT_GT(gap.beyond_rms, 0.01);
}

// what the simulator holds beyond the model's terms leaves a validation recording as it leaves the training one
TEST(SimulatorGap, TakesTheSameOfACopyGivenAsValidation) {
  auto [recording, motion, truth] = bench();
  recording.simulated_torque = simulator(motion, 0.9 * truth) + 0.4 * motion.q;
  recording.torque += 0.4 * motion.q;
  auto const pipeline = clean_pipeline(recording);
  auto const gap = gap_to_simulator(recording, pipeline);
  Recording const validation = without_simulator(recording, pipeline, gap.simulator_parameters);
  EXPECT_EQ(validation.torque, gap.recording.torque);
  EXPECT_EQ(validation.gear_load, gap.recording.gear_load);
  EXPECT_EQ(validation.simulated_torque.size(), 0);

  Recording plain = recording;
  plain.simulated_torque.resize(0);
  EXPECT_EQ(without_simulator(plain, pipeline, gap.simulator_parameters).torque, recording.torque);
}

// a spring that the simulator has and the model has not presses the gear as a term of the model would
TEST(SimulatorGap, KeepsWhatPassesTheGearAsItsLoad) {
  auto [recording, motion, truth] = bench();
  recording.simulated_torque = simulator(motion, truth) + 0.4 * motion.q;
  auto const pipeline = clean_pipeline(recording);
  auto const gap = gap_to_simulator(recording, pipeline);
  ASSERT_EQ(gap.recording.gear_load.size(), motion.q.size());
  // what the terms take of a spring on this motion is in their own load; both as the rows see them, low-passed
  auto const record = pipeline.process(recording);
  Eigen::VectorXd const load =
      pipeline.filtered(gap.recording.gear_load + gap.simulator_parameters[0] * record.motion.ddq, record);
  Eigen::VectorXd const whole = pipeline.filtered(truth[0] * motion.ddq + 0.4 * motion.q, record);
  // a mean is friction of one direction more than of the other, as far as anybody can tell
  auto const about_mean = [](Eigen::VectorXd const& signal) -> Eigen::VectorXd {
    return signal.array() - signal.mean();
  };
  EXPECT_LT(about_mean(load - whole).norm(), 0.25 * about_mean(whole).norm());
}

TEST(SimulatorGap, DoesNotChatterWhereTheJointRests) {
  // three strokes, a second of rest with an encoder that flickers between two steps, three strokes
  Recording recording = bench().recording;
  Eigen::Index const from = 3000, length = 1000, margin = 100, n = 7000;
  recording.time_s.conservativeResize(n);
  recording.reference.resize(0);
  recording.position.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    double const t = 1e-3 * static_cast<double>(k < from ? k : std::max(from, k - length));
    bool const rests = k >= from && k < from + length;
    recording.position[k] =
        1.0 - std::cos(2.0 * std::numbers::pi * t) + (rests && k % 7 < 3 ? recording.rows.encoder_step : 0.0);
  }
  recording.torque.setZero(n);
  Eigen::Vector4d const truth = clean_joint().truth;
  recording.torque = simulator(users_motion(recording), truth);
  recording.torque.segment(from, length).setConstant(0.1);
  recording.simulated_torque = simulator(users_motion(recording), truth);

  Eigen::VectorXd const at_rest = gap_to_simulator(recording, clean_pipeline(recording))
                                      .recording.torque.segment(from + margin, length - 2 * margin);
  double const largest_step =
      (at_rest.tail(at_rest.size() - 1) - at_rest.head(at_rest.size() - 1)).cwiseAbs().maxCoeff();
  // the simulator itself flickers between the two signs of its Coulomb friction
  ASSERT_GT((recording.simulated_torque.segment(from, length).array() - truth[3]).abs().maxCoeff(), 0.9 * truth[2]);
  EXPECT_LT(largest_step, 1e-3 * truth[2]);
}

}  // namespace simulator_gap_test
