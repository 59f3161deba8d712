#include "engine/robot/tip_wrench.hpp"

#include <vector>

#include "engine/base/contract.hpp"
#include "engine/robot/link_motion.hpp"

namespace torquescope {
namespace {

using Eigen::Index;

// at the tip's origin, along the tip's axes
Wrench along_tip(Wrench const& wrench, SerialChain const& chain, std::vector<FramePose> const& poses) {
  FramePose tip = chain.base;
  for (auto const& pose : poses) tip = tip * pose;
  Eigen::Matrix3d const into = (tip * chain.flange).rotation.transpose();
  return {into * wrench.force, into * wrench.moment};
}

}  // namespace

Eigen::MatrixXd torques_of_wrench(SerialChain const& chain, Eigen::Ref<Eigen::MatrixXd const> const& q,
                                  Eigen::Ref<Eigen::MatrixXd const> const& wrench, WrenchFrame frame) {
  Index const n = q.rows(), joints = chain.size();
  TORQUESCOPE_EXPECT(q.cols() == joints && wrench.rows() == n && wrench.cols() == 6);
  Eigen::MatrixXd torques(n, joints);
  std::vector<FramePose> poses(chain.joints.size());
  for (Index k = 0; k < n; ++k) {
    for (Index j = 0; j < joints; ++j)
      poses[static_cast<std::size_t>(j)] = joint_pose(chain.joints[static_cast<std::size_t>(j)], q(k, j));
    Wrench carried{wrench.row(k).head<3>().transpose(), wrench.row(k).tail<3>().transpose()};
    if (frame == WrenchFrame::base) carried = along_tip(carried, chain, poses);
    carried = carried.seen_from(chain.flange);
    for (Index j = joints - 1; j >= 0; --j) {
      auto const at = static_cast<std::size_t>(j);
      torques(k, j) = carried.along(chain.joints[at].kind);
      carried = carried.seen_from(poses[at]);
    }
  }
  return torques;
}

}  // namespace torquescope
