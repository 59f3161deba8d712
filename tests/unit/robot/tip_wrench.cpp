// A wrench at the tip does as much work as the torques that it gives to the joints.

#include "engine/robot/tip_wrench.hpp"

#include <gtest/gtest.h>

#include "unit/robot/example_arms.hpp"

namespace torquescope {
namespace tip_wrench_test {

FramePose tip_of(SerialChain const& chain, Eigen::VectorXd const& q) {
  FramePose tip = chain.base;
  for (std::size_t j = 0; j < chain.joints.size(); ++j)
    tip = tip * joint_pose(chain.joints[j], q[static_cast<Eigen::Index>(j)]);
  return tip * chain.flange;
}

// 6 x N by central differences of the pose: velocity and spin along the base's axes
Eigen::MatrixXd jacobian_of(SerialChain const& chain, Eigen::VectorXd const& q) {
  constexpr double step = 1e-5;
  Eigen::Matrix3d const turn = tip_of(chain, q).rotation;
  Eigen::MatrixXd jacobian(6, q.size());
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    Eigen::VectorXd const shift = step * Eigen::VectorXd::Unit(q.size(), j);
    FramePose const ahead = tip_of(chain, q + shift), behind = tip_of(chain, q - shift);
    jacobian.col(j).head<3>() = (ahead.position - behind.position) / (2.0 * step);
    Eigen::Matrix3d const spin = (ahead.rotation - behind.rotation) / (2.0 * step) * turn.transpose();
    jacobian.col(j).tail<3>() << spin(2, 1), spin(0, 2), spin(1, 0);
  }
  return jacobian;
}

TEST(TipWrench, DoesTheWorkOfItsTorques) {
  for (std::uint32_t number = 0; number < 50; ++number) {
    auto arm = test::random_arm(number, number % 2 == 0);
    arm.chain.base = joint_pose(arm.chain.joints.front(), 0.4);
    arm.chain.flange = joint_pose(arm.chain.joints.back(), -0.7);
    Eigen::Matrix<double, 6, 1> wrench;
    wrench << 3.0, -2.0, 5.0, 0.4, 0.7, -0.6;
    Eigen::VectorXd const expected = jacobian_of(arm.chain, arm.q).transpose() * wrench;
    Eigen::VectorXd const of_base =
        torques_of_wrench(arm.chain, arm.q.transpose(), wrench.transpose(), WrenchFrame::base).row(0).transpose();
    EXPECT_LT((of_base - expected).norm(), 1e-7 * (1.0 + expected.norm())) << number;
    Eigen::Matrix3d const into = tip_of(arm.chain, arm.q).rotation.transpose();
    Eigen::Matrix<double, 6, 1> along_tip;
    along_tip << into * wrench.head<3>(), into * wrench.tail<3>();
    Eigen::VectorXd const of_tip =
        torques_of_wrench(arm.chain, arm.q.transpose(), along_tip.transpose(), WrenchFrame::tip).row(0).transpose();
    EXPECT_LT((of_tip - of_base).norm(), 1e-12 * (1.0 + of_base.norm())) << number;
  }
}

}  // namespace tip_wrench_test
}  // namespace torquescope
