// Laws that every listed effect obeys, and the numbers of each one at states computed by hand.

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>

#include "engine/effects/effect.hpp"
#include "unit/effects/rich_motion.hpp"

namespace torquescope {
namespace {

class EveryEffect : public testing::TestWithParam<Effect const*> {};

TEST_P(EveryEffect, TorqueIsColumnsTimesParameters) {
  auto const& effect = *GetParam();
  auto const motion = test::rich_motion(50);
  auto const count = static_cast<Eigen::Index>(effect.parameters().size());
  Eigen::MatrixXd phi(50, count);
  effect.columns({motion}, {}, phi);
  Eigen::VectorXd const parameters = Eigen::VectorXd::LinSpaced(count, 0.3, 1.7);
  for (Eigen::Index i = 0; i < 50; ++i) {
    double const torque = effect.torque(test::state_at(motion, i), {parameters.data(), parameters.data() + count}, {});
    EXPECT_NEAR(torque, phi.row(i).dot(parameters), 1e-14) << effect.name() << " at sample " << i;
  }
}

TEST_P(EveryEffect, IsFoundByItsNameAndExplainsItself) {
  auto const& effect = *GetParam();
  EXPECT_EQ(find_effect(effect.name()), &effect);
  EXPECT_FALSE(effect.title().empty());
  EXPECT_FALSE(effect.equation().empty());
  EXPECT_FALSE(effect.source().empty());
  for (auto const& parameter : effect.parameters()) EXPECT_FALSE(parameter.unit_revolute.empty());
}

TEST_P(EveryEffect, IsDryFrictionExactlyWhenItsTorqueJumpsAtRest) {
  auto const& effect = *GetParam();
  std::vector<double> const ones(effect.parameters().size(), 1.0);
  double const forwards = effect.torque({0.0, 0.3, 1e-300, 0.1}, ones, {});
  double const backwards = effect.torque({0.0, 0.3, -1e-300, 0.1}, ones, {});
  EXPECT_EQ(effect.is_dry_friction(), std::abs(forwards - backwards) > 0.5);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryEffect, testing::ValuesIn(effect_choices()),
                         [](auto const& choice) { return choice.param->name(); });

TEST(EffectNames, AreDifferentAndSoAreParameterNames) {
  std::set<std::string> effects, parameters;
  for (auto const* effect : effect_choices()) {
    EXPECT_TRUE(effects.insert(effect->name()).second) << effect->name();
    for (auto const& parameter : effect->parameters())
      EXPECT_TRUE(parameters.insert(parameter.name).second) << parameter.name;
  }
  EXPECT_EQ(find_effect("no_such_effect"), nullptr);
}

double torque(std::string const& name, JointState const& state, std::vector<double> const& parameters) {
  return find_effect(name)->torque(state, parameters, {});
}

TEST(SeedEffects, FollowEquation3) {
  JointState const forwards{0.0, 0.5, 2.0, 3.0}, backwards{0.0, 0.5, -2.0, 3.0};
  EXPECT_EQ(torque("inertia", forwards, {0.0036}), 0.0036 * 3.0);
  EXPECT_EQ(torque("viscous", backwards, {0.0164}), -0.0164 * 2.0);
  EXPECT_EQ(torque("coulomb_positive", forwards, {0.0089}), 0.0089);
  EXPECT_EQ(torque("coulomb_positive", backwards, {0.0089}), 0.0);
  EXPECT_EQ(torque("coulomb_negative", forwards, {-0.2582}), 0.0);
  EXPECT_EQ(torque("coulomb_negative", backwards, {-0.2582}), -0.2582);
}

TEST(DryFriction, IsZeroAtRest) {
  JointState const rest{0.0, 0.5, 0.0, 3.0};
  for (auto const* name : {"coulomb", "coulomb_positive", "coulomb_negative"})
    EXPECT_EQ(torque(name, rest, {1.0}), 0.0);
}

TEST(DissipativeEffects, NeverDriveTheJoint) {
  for (double const velocity : {-3.0, -1e-9, 0.0, 1e-9, 3.0}) {
    JointState const state{0.0, 0.2, velocity, 0.0};
    EXPECT_GE(velocity * torque("viscous", state, {0.02}), 0.0);
    EXPECT_GE(velocity * torque("coulomb", state, {0.1}), 0.0);
    EXPECT_GE(velocity * torque("coulomb_positive", state, {0.1}), 0.0);
    EXPECT_GE(velocity * torque("coulomb_negative", state, {-0.1}), 0.0);
  }
}

TEST(Gravity, IsTheSlopeOfAPotential) {
  // centre of mass anywhere: U = -g_sin cos(q) + g_cos sin(q)
  double const g_sin = 1.7, g_cos = -0.4, step = 1e-6;
  auto const potential = [&](double q) { return -g_sin * std::cos(q) + g_cos * std::sin(q); };
  for (double q = -3.0; q < 3.0; q += 0.37) {
    double const slope = (potential(q + step) - potential(q - step)) / (2.0 * step);
    EXPECT_NEAR(torque("gravity", {0.0, q, 1.0, 1.0}, {g_sin, g_cos}), slope, 1e-9);  // step^2 and rounding / step
  }
}

}  // namespace
}  // namespace torquescope
