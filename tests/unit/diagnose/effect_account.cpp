// The size that is told of an effect is what the model's own terms would not imitate, at the place that is told with
// it; and friction has no place in a rest.

#include "engine/diagnose/strip_account.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "unit/pipeline/clean_records.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace effect_account_test {

EffectAccount account_with(SimulationPlan plan, Regressor const& regressor, ShapedEffect effect) {
  Recording const recording = recorded(simulate_joint(plan, 3));
  FilterOptions const filter = clean_filter();
  Section const section{};
  DecisionQuestion const question{{&recording, 1}, {}, regressor, filter, section};
  JointDecision decision;
  decision.rows = joint_strips(question);
  DelayChoice const as_read{DelaySearch::given, 0.0, 0.0};
  FittedModel const plain = fitted_model(decision.rows, regressor, {}, nullptr, as_read);
  decision.final = fitted_model(decision.rows, regressor, {std::move(effect)}, plain.fitted.get(), as_read);
  Eigen::MatrixXd const replicates = Eigen::MatrixXd::Zero(decision.final.fitted->residual().size(), 8);
  return account_of(decision, mismatch_rows(decision.final, replicates), 0);
}

// within 0.3 rad a spring is gravity to a hundredth: whatever stiffness was fitted, the joint deviates by next to
// nothing
TEST(EffectAccount, CountsNothingThatGravityTakesUp) {
  Regressor const regressor({"inertia", "viscous", "coulomb", "offset", "gravity"}, JointKind::revolute);
  auto joint = clean_joint();
  joint.plan.plant = plant({{"inertia", joint.truth[0]},
                            {"viscous", joint.truth[1]},
                            {"coulomb", joint.truth[2]},
                            {"gravity_sin", 1.0},
                            {"spring", 20.0}});
  joint.plan.reference.amplitude = 0.3;
  auto const account = account_with(joint.plan, regressor, {find_effect("spring"), {}});
  double largest = 0.0;
  for (double torque : account.curve.modelled) largest = std::max(largest, std::abs(torque));
  EXPECT_GT(largest, 1.0);
  EXPECT_LT(account.peak, 0.05 * largest);
  EXPECT_LE(account.rms, account.peak);
}

TEST(EffectAccount, DoesNotLookForFrictionWhereTheJointRests) {
  auto joint = clean_joint();
  joint.plan.plant = plant({{"inertia", joint.truth[0]},
                            {"viscous", joint.truth[1]},
                            {"coulomb", joint.truth[2]},
                            {"stribeck", 0.5},
                            {"stribeck_speed", 0.3},
                            {"stribeck_exponent", 1.0}});
  joint.plan.controller.kind = "pid";
  joint.plan.simulation.duration_s = 30.0;
  joint.plan.reference.kind = "trapezoid";
  joint.plan.reference.amplitude = 0.5;
  joint.plan.reference.speeds = {1.0};
  joint.plan.reference.max_acceleration = 2.0;
  joint.plan.reference.dwell_s = 1.0;
  auto const account = account_with(joint.plan, clean_regressor(), {find_effect("stribeck"), {0.3, 1.0}});
  EXPECT_EQ(account.region.axis, "velocity");
  EXPECT_LT(account.places.front().from, -0.05);
  EXPECT_GT(account.places.back().to, 0.05);
  EXPECT_LT(account.region.to, 0.6);
}

TEST(EffectAccount, TellsTheSizeThatBelongsToThePlace) {
  Eigen::VectorXd const at = Eigen::VectorXd::LinSpaced(11, -5.0, 5.0);
  Eigen::VectorXd const torque = (at.array() < 0.0).select(2.0 * at, at);
  EXPECT_EQ(peak_in({{"load", 2.0, 4.0, "N m"}}, at, torque), 4.0);
  EXPECT_EQ(peak_in({{"load", -2.5, -1.0, "N m"}, {"load", 2.0, 3.0, "N m"}}, at, torque), 4.0);
  EXPECT_EQ(peak_in({{"load", 6.0, 7.0, "N m"}}, at, torque), 10.0);
}

}  // namespace effect_account_test
