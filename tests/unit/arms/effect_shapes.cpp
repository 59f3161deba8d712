// An effect with a shape beside an arm: planted at one joint, found by the fit of the whole arm.

#include "engine/diagnose/arms/effect_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/effects/beside_arm.hpp"
#include "engine/robot/inverse_dynamics.hpp"
#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace effect_shapes_test {

constexpr double rate_hz = 100.0, stribeck_nm = 2.0, stribeck_speed = 0.2;
constexpr std::size_t planted = 1;

SerialChain three_revolute_joints() {
  for (std::uint32_t number = 1;; ++number) {
    auto chain = test::random_arm(number, false, true).chain;
    bool const turns = std::all_of(chain.joints.begin(), chain.joints.end(),
                                   [](ChainJoint const& one) { return one.kind == JointKind::revolute; });
    if (turns && chain.joints.size() == 3) return chain;
  }
}

class EffectShapes : public testing::Test {
 protected:
  RecordedArm recorded(unsigned number) const {
    constexpr Eigen::Index n = 3000;
    std::mt19937 random(number);
    std::normal_distribution<double> noise(0.0, 0.05);
    RecordedArm arm;
    std::size_t const joints = chain.joints.size();
    for (std::size_t j = 0; j < joints; ++j) {
      Recording one;
      one.name = "run.csv";
      one.rate_hz = rate_hz;
      one.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1) / rate_hz);
      one.position.resize(n);
      one.torque.resize(n);
      arm.joints.push_back(std::move(one));
    }
    Eigen::VectorXd const plain = standard_parameters(chain, DriveInertias::included);
    for (Eigen::Index i = 0; i < n; ++i) {
      double const t = static_cast<double>(i) / rate_hz;
      Eigen::VectorXd q(joints), dq(joints), ddq(joints);
      for (std::size_t j = 0; j < joints; ++j) {
        double const w = 0.5 + 0.2 * static_cast<double>(j), v = 1.3 + 0.4 * static_cast<double>(number + j);
        auto const k = static_cast<Eigen::Index>(j);
        q[k] = std::sin(w * t) + 0.3 * std::cos(v * t);
        dq[k] = w * std::cos(w * t) - 0.3 * v * std::sin(v * t);
        ddq[k] = -w * w * std::sin(w * t) - 0.3 * v * v * std::cos(v * t);
      }
      Eigen::VectorXd const tau = inverse_dynamics(chain, plain, q, dq, ddq);
      for (std::size_t j = 0; j < joints; ++j) {
        auto const k = static_cast<Eigen::Index>(j);
        double const ratio = dq[k] / stribeck_speed;
        double const falls = j == planted ? stribeck_nm * std::exp(-ratio * ratio) : 0.0;
        arm.joints[j].position[i] = q[k];
        arm.joints[j].torque[i] = tau[k] + 0.4 * dq[k] + std::copysign(0.5 + falls, dq[k]) + noise(random);
      }
    }
    return arm;
  }

  SerialChain const chain = three_revolute_joints();
  FilterOptions const filter = [] {
    FilterOptions options;
    options.cutoff_hz = 20.0;
    options.parallel_cutoff_hz = 8.0;
    options.decimate_to_hz = 25.0;
    return options;
  }();
  Section const section{};

  ArmModel with(std::vector<double> const& shape) const {
    ArmTerms terms{{"viscous", "coulomb"}};
    terms.effects = {{find_effect("stribeck"), planted, shape}};
    return {chain, terms, Section{}};
  }
};

TEST_F(EffectShapes, AreFoundByTheFitOfTheWholeArm) {
  ArmFilter const arm_filter{filter, section};
  std::vector<RecordedArm> const train{recorded(1)};
  auto const effects = refined_effects(with({}), train, arm_filter);
  ASSERT_EQ(effects.size(), 1u);
  ASSERT_EQ(effects[0].shape.size(), 2u);
  EXPECT_NEAR(effects[0].shape[0], stribeck_speed, 0.25 * stribeck_speed);
  EXPECT_EQ(shape_name(effects[0], 0), "stribeck_speed_2");
  ArmModel const model = with({}).with_effects(effects);
  auto const names = model.names();
  PlainArmFit const fit = fit_parameters(model, train, arm_filter);
  auto const found = [&](char const* name) {
    return fit.parameters[std::find(names.begin(), names.end(), name) - names.begin()];
  };
  // rows near a reversal are left out: the level at rest is hardly seen, the curve where the joint moves is
  for (double const speed : {0.2, 0.4, 0.8}) {
    double const effect = found("stribeck_2") * std::exp(-std::pow(speed / effects[0].shape[0], effects[0].shape[1]));
    double const truth = 0.4 * speed + 0.5 + stribeck_nm * std::exp(-std::pow(speed / stribeck_speed, 2.0));
    EXPECT_NEAR(found("viscous_2") * speed + found("coulomb_2") + effect, truth, 0.03 * truth) << speed;
  }
  PlainArmFit const bare = fit_parameters(model.with_effects({}), train, arm_filter);
  EXPECT_LT(fit.energies[planted].left, 0.5 * bare.energies[planted].left);
}

TEST_F(EffectShapes, BeginWhereTheJobSaysAndEndWhereTheGridLeadsTo) {
  ArmFilter const arm_filter{filter, section};
  std::vector<RecordedArm> const train{recorded(1)};
  auto const anywhere = refined_effects(with({}), train, arm_filter),
             near = refined_effects(with({0.1, 1.5}), train, arm_filter);
  EXPECT_NEAR(near[0].shape[0], anywhere[0].shape[0], 0.02 * anywhere[0].shape[0]);
}

TEST(BesideArm, EffectsOfChannelsEventsAndRigidBodiesHaveNoPlace) {
  for (char const* name : {"delay", "payload_change", "gravity", "joint_zero", "friction_of_next_joint"})
    EXPECT_FALSE(why_not_beside_arm(*find_effect(name), JointKind::revolute).empty()) << name;
  for (char const* name : {"stribeck", "cogging", "load_dependent_friction", "power_law_viscous", "spring"})
    EXPECT_TRUE(why_not_beside_arm(*find_effect(name), JointKind::revolute).empty()) << name;
}

}  // namespace effect_shapes_test
}  // namespace torquescope
