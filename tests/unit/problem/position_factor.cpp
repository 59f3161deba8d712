// A position in another unit than rad is told by the torque of gravity, and by nothing else.

#include "engine/fit/problem/position_factor.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "unit/problem/joint_data.hpp"

using namespace torquescope;
using namespace torquescope::test;

namespace position_factor_test {

constexpr double degree = std::numbers::pi / 180.0;

std::vector<std::string> const arm_terms{"inertia", "viscous", "coulomb", "offset", "gravity"};

Motion scaled(Motion motion, double factor) {
  motion.q *= factor;
  motion.dq *= factor;
  motion.ddq *= factor;
  return motion;
}

struct Arm {
  double reach = 1.0;  // of the motion, times that of multisine()
  double noise = 0.05, spring = 0.0;
  std::uint32_t run = 1;
};

// an arm that moves in rad, logged in units of which one is `unit` rad
RegressionData logged(Arm const& arm, double unit, std::vector<std::string> const& terms = arm_terms) {
  Regressor const regressor(terms, JointKind::revolute);
  Motion motion = scaled(multisine(20.0), arm.reach);
  motion.q.array() += 0.4;
  Regressor const plant(arm_terms, JointKind::revolute);
  Eigen::VectorXd truth(static_cast<Eigen::Index>(plant.size()));
  truth << 0.09, 0.35, 0.6, 0.04, 4.0, 0.7;
  Eigen::VectorXd const torque =
      plant.columns(motion) * truth + arm.spring * motion.q + white_noise(motion.q.size(), arm.run, arm.noise);
  return regression_data(scaled(motion, 1.0 / unit), regressor, torque);
}

std::optional<PositionFactor> told(Arm const& arm, double unit) {
  return position_factor(logged(arm, unit), Regressor(arm_terms, JointKind::revolute));
}

TEST(PositionFactor, NamesTheUnitThatWasForgotten) {
  std::uint32_t run = 1;
  for (double reach : {1.6, 2.0})  // on shorter ways turns taken for rad are nearly a straight line
    for (auto const& [unit, words] : {std::pair(degree, "degrees"), std::pair(2.0 * std::numbers::pi, "turns"),
                                      std::pair(1e-3, "thousandths of a rad")}) {
      auto const factor = told({.reach = reach, .run = run++}, unit);
      ASSERT_TRUE(factor.has_value()) << words << " at " << reach;
      EXPECT_EQ(factor->words, words) << reach;
      EXPECT_NEAR(factor->factor, unit, 1e-9);
      EXPECT_GT(factor->error_before, 5.0 * factor->error_after);
    }
}

TEST(PositionFactor, TellsTheRatioOfAGear) {
  for (double ratio : {6.0, 36.0, 100.0}) {
    auto const factor = told({.reach = 1.5}, 1.0 / ratio);
    ASSERT_TRUE(factor.has_value()) << ratio;
    EXPECT_EQ(factor->words, "") << ratio;
    EXPECT_NEAR(1.0 / factor->factor, ratio, 0.03 * ratio);
  }
}

TEST(PositionFactor, IsSilentWhereThePositionIsInRad) {
  for (std::uint32_t run = 1; run <= 60; ++run)
    for (double reach : {0.1, 0.5, 1.5})
      EXPECT_FALSE(told({.reach = reach, .noise = 0.02 * run, .run = run}, 1.0).has_value()) << run << ' ' << reach;
}

// a spring that the model lacks looks like gravity at any small factor
TEST(PositionFactor, IsSilentWhereAnySmallFactorDoesAsWell) {
  for (double spring : {20.0, -60.0, 200.0})
    for (double reach : {0.3, 1.0})
      EXPECT_FALSE(told({.reach = reach, .spring = spring}, 1.0).has_value()) << spring << ' ' << reach;
}

TEST(PositionFactor, NeedsAnEffectThatIsNoPowerOfThePosition) {
  std::vector<std::string> const flat{"inertia", "viscous", "coulomb", "offset", "spring"};
  Regressor const regressor(flat, JointKind::revolute);
  EXPECT_FALSE(tells_unit_of_position(regressor));
  EXPECT_TRUE(tells_unit_of_position(Regressor(arm_terms, JointKind::revolute)));
  EXPECT_FALSE(position_factor(logged({}, degree, flat), regressor).has_value());
}

}  // namespace position_factor_test
