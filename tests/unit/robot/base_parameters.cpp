#include "engine/robot/base_parameters.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <array>

#include "engine/robot/inverse_dynamics.hpp"
#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace base_parameters_test {

Eigen::Index rank(SerialChain const& chain, DriveInertias drives) { return BaseParameters(chain, drives).size(); }

TEST(BaseParameters, RanksOfKnownArms) {
  std::array<Eigen::Index, 6> const rigid{1, 8, 15, 22, 29, 36}, with_drives{1, 8, 16, 24, 32, 40};
  for (std::size_t n = 1; n <= 6; ++n) {
    EXPECT_EQ(rank(test::crs_a465(n), DriveInertias::left_out), rigid[n - 1]) << n;
    EXPECT_EQ(rank(test::crs_a465(n), DriveInertias::included), with_drives[n - 1]) << n;
  }
  EXPECT_EQ(rank(test::ur10e(), DriveInertias::left_out), 36);
  EXPECT_EQ(rank(test::ur10e(), DriveInertias::included), 40);
  EXPECT_EQ(rank(test::panda(), DriveInertias::left_out), 43);
  EXPECT_EQ(rank(test::panda(), DriveInertias::included), 48);
  EXPECT_EQ(rank(test::puma_560(), DriveInertias::left_out), 36);
  EXPECT_EQ(rank(test::puma_560(), DriveInertias::included), 40);
}

TEST(BaseParameters, GiveTheTorqueOfTheStandardOnes) {
  for (std::uint32_t number = 0; number < 100; ++number) {
    auto const arm = test::random_arm(number, number % 2 == 0);
    BaseParameters const base(arm.chain, DriveInertias::included);
    auto const chi = standard_parameters(arm.chain, DriveInertias::included);
    auto const phi = arm_regressor(arm.chain, arm.q, arm.dq, arm.ddq, DriveInertias::included);
    Eigen::VectorXd const tau = phi * chi;
    auto const values = base.from_standard(chi);
    EXPECT_LT((tau - base.pick(phi) * values).norm(), 1e-11 * tau.norm()) << number;
    EXPECT_LT((tau - phi * base.to_standard(values)).norm(), 1e-11 * tau.norm()) << number;
    EXPECT_LT((base.from_standard(base.to_standard(values)) - values).norm(), 1e-15);
  }
}

}  // namespace base_parameters_test
}  // namespace torquescope
