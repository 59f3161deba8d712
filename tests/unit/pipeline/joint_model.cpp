// The model of a diagnosis is its baseline and its effects side by side, and simulates what it fits: a replicate of the
// model gives its parameters back, and is fitted like a joint that a simulator of another kind made.

#include "engine/infer/pipeline/joint_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "unit/pipeline/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace joint_model_test {

constexpr double stribeck_torque = 0.5, stribeck_speed = 0.3, stribeck_exponent = 1.0;
constexpr double coulomb = 1.3;

Effect const& stribeck() { return *find_effect("stribeck"); }
Effect const& cogging() { return *find_effect("cogging"); }

Eigen::VectorXd baseline() { return Eigen::Vector4d(0.036, 0.164, coulomb, -0.125); }

BaselineReference reference() {
  BaselineReference made;
  made.scales.coulomb_positive = made.scales.coulomb_negative = coulomb;
  made.scales.cutoff_hz = 30.0;
  made.scales.peak_speed = 3.0;
  made.parameters = baseline();
  return made;
}

ShapedEffect shaped_stribeck() { return {&stribeck(), {stribeck_speed, stribeck_exponent}}; }

JointModel stribeck_model() { return {clean_regressor(), reference(), {shaped_stribeck()}}; }

Eigen::VectorXd with(Eigen::VectorXd const& parameters, double more) {
  Eigen::VectorXd all(parameters.size() + 1);
  all << parameters, more;
  return all;
}

Recording simulated(double of_stribeck, std::uint64_t seed) {
  auto joint = clean_joint();
  joint.plan.plant = plant({{"inertia", 0.036},
                            {"viscous", 0.164},
                            {"coulomb", coulomb},
                            {"offset", -0.125},
                            {"stribeck", of_stribeck},
                            {"stribeck_speed", stribeck_speed},
                            {"stribeck_exponent", stribeck_exponent}});
  return recorded(simulate_joint(joint.plan, seed));
}

Motion const& motion() {
  static Motion const made = differentiate(simulated(stribeck_torque, 3), clean_filter(), {});
  return made;
}

TEST(JointModel, WithoutEffectsIsItsRegressor) {
  JointModel const model(clean_regressor());
  EXPECT_EQ(model.size(), 4U);
  EXPECT_EQ(model.columns(motion(), {}), clean_regressor().columns(motion()));
  EXPECT_EQ(model.column_owners().size(), 4U);
}

TEST(JointModel, PutsTheColumnsOfAnEffectBehindTheBaseline) {
  JointModel const model = stribeck_model();
  ASSERT_EQ(model.size(), 5U);
  EXPECT_EQ(model.first_parameter(0), 4U);
  Eigen::MatrixXd const columns = model.columns(motion(), {});
  EXPECT_EQ(columns.leftCols(4), clean_regressor().columns(motion()));

  Eigen::MatrixXd own(motion().q.size(), 1);
  stribeck().columns({motion(), reference().scales, {}, {}}, shaped_stribeck().shape, own);
  EXPECT_EQ(columns.rightCols(1), own);
  // and by its equation
  Eigen::ArrayXd const faded = (-(motion().dq.array().abs() / stribeck_speed)).exp() * motion().dq.array().sign();
  EXPECT_LT((own.col(0).array() - faded).abs().maxCoeff(), 1e-12);
}

TEST(JointModel, KeepsTheOrderOfItsEffects) {
  JointModel const model(clean_regressor(), reference(), {{&cogging(), {9.0}}, shaped_stribeck()});
  ASSERT_EQ(model.size(), 7U);
  EXPECT_EQ(model.first_parameter(0), 4U);
  EXPECT_EQ(model.first_parameter(1), 6U);
  EXPECT_EQ(model.first_parameter(2), 7U);
  Eigen::MatrixXd const columns = model.columns(motion(), {});
  Eigen::ArrayXd const angle = 9.0 * motion().q.array();
  EXPECT_LT((columns.col(4).array() - angle.cos()).abs().maxCoeff(), 1e-12);
  EXPECT_LT((columns.col(5).array() - angle.sin()).abs().maxCoeff(), 1e-12);
  EXPECT_EQ(columns.col(6), stribeck_model().columns(motion(), {}).col(4));

  auto const owners = model.column_owners();
  std::vector<std::string> names;
  for (auto const& owner : owners) names.push_back(owner.name);
  EXPECT_EQ(names, (std::vector<std::string>{"inertia", "viscous", "coulomb", "offset", "cogging_cos", "cogging_sin",
                                             "stribeck"}));
  EXPECT_EQ(owners[4].term, owners[5].term);
  EXPECT_EQ(owners[6].term, owners[5].term + 1);
  EXPECT_EQ(owners[6].unit, "N m");

  Eigen::VectorXd const parameters = Eigen::VectorXd::LinSpaced(7, 1.0, 7.0);
  EXPECT_EQ(model.effect_parameters(0, parameters), (std::vector<double>{5.0, 6.0, 9.0}));
  EXPECT_EQ(model.effect_parameters(1, parameters), (std::vector<double>{7.0, stribeck_speed, stribeck_exponent}));
}

TEST(JointModel, TellsEffectsTheReferenceWhateverIsFitted) {
  // the baseline's load and model torque on a motion, its scales as they were
  FittedBaseline const told = on_motion(clean_regressor(), reference(), motion());
  EXPECT_LT((told.model_torque - clean_regressor().columns(motion()) * baseline()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((told.load_torque - 0.036 * motion().ddq).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(told.scales.coulomb_positive, coulomb);
  EXPECT_EQ(told.scales.peak_speed, 3.0);
}

// the load that a simulator knows of presses the gear beside the baseline's own
TEST(JointModel, TellsEffectsTheGearLoadOfItsRecording) {
  Recording recording = simulated(stribeck_torque, 3);
  recording.gear_load = 2.0 * recording.position;
  JointModel model(clean_regressor(), reference(), {{find_effect("load_dependent_friction"), {1.0, 0.0}}});
  Eigen::ArrayXd const inertia = 0.036 * motion().ddq.array(), sign = motion().dq.array().sign();
  Eigen::ArrayXd const without = model.columns(motion(), {}).col(4).array();
  EXPECT_LT((without - sign * inertia.abs()).abs().maxCoeff(), 1e-9);
  model.load_as_in(recording);
  Eigen::ArrayXd const with_load = model.columns(motion(), {}).col(4).array();
  EXPECT_LT((with_load - sign * (inertia + recording.gear_load.array()).abs()).abs().maxCoeff(), 1e-9);
  // of another recording, its own
  recording.gear_load.resize(0);
  model.load_as_in(recording);
  EXPECT_LT((model.columns(motion(), {}).col(4).array() - without).abs().maxCoeff(), 1e-12);
}

// what is missing in the torque channel is missing of all that the motor gives
TEST(JointModel, TellsEffectsOfTheTorqueTheLoadOfOtherJoints) {
  Recording recording = simulated(stribeck_torque, 3);
  recording.gear_load = 2.0 * recording.position;
  double const late_s = 4.0 / recording.rate_hz;
  JointModel model(clean_regressor(), reference(), {{find_effect("delay"), {late_s}}});
  model.load_as_in(recording);
  Eigen::VectorXd const motor = clean_regressor().columns(motion()) * baseline() + recording.gear_load;
  Eigen::VectorXd const column = model.columns(motion(), {}).col(4);
  for (Eigen::Index k = 10; k < motor.size(); k += 97)
    EXPECT_NEAR(column[k], (motor[k - 4] - motor[k]) / late_s, 1e-6) << k;
  // limits of the channel are looked for where the whole torque has its peaks
  BesideMotion const beside{nullptr, &recording.gear_load};
  auto const told = fitted_baseline(clean_regressor(), {baseline().data(), 4}, motion(), 30.0, 0.0, beside);
  EXPECT_NEAR(told.scales.torque_highest, (motion().torque + recording.gear_load).maxCoeff(), 1e-12);
}

RecordPipeline pipeline_of(JointModel model, Recording const& recording) {
  return {std::move(model), clean_filter(), recording.rate_hz, recording.position.size()};
}

// a Stribeck curve cannot be negative: where least squares would make it so, the fit is that of the baseline alone
TEST(JointModel, GivesNoNegativeValueToAParameterThatCannotHaveOne) {
  Recording const recording = simulated(-0.5 * stribeck_torque, 5);
  Eigen::VectorXd const fit = pipeline_of(stribeck_model(), recording).process(recording).parameters;
  Eigen::VectorXd const alone = pipeline_of(JointModel(clean_regressor()), recording).process(recording).parameters;
  EXPECT_EQ(fit[4], 0.0);
  EXPECT_LT((fit.head(4) - alone).norm(), 1e-12 * alone.norm());
}

}  // namespace joint_model_test
