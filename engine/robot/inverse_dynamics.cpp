#include "engine/robot/inverse_dynamics.hpp"

#include <vector>

#include "engine/base/contract.hpp"
#include "engine/robot/link_motion.hpp"
#include "engine/robot/vector3.hpp"

namespace torquescope {

namespace {

using Eigen::Index;
using Eigen::Vector3d;

std::vector<LinkMotion> outward(SerialChain const& chain, JointVector const& q, JointVector const& dq,
                                JointVector const& ddq) {
  TORQUESCOPE_EXPECT(q.size() == chain.size() && dq.size() == chain.size() && ddq.size() == chain.size());
  std::vector<LinkMotion> links(chain.joints.size());
  for (std::size_t i = 0; i < links.size(); ++i) links[i].pose = joint_pose(chain.joints[i], q[static_cast<Index>(i)]);
  move_outward(chain, dq, ddq, links);
  return links;
}

// inertia * w = inertia_columns(w) * (xx, xy, xz, yy, yz, zz)
Eigen::Matrix<double, 3, 6> inertia_columns(Vector3d const& w) {
  Eigen::Matrix<double, 3, 6> columns;
  columns << w.x(), w.y(), w.z(), 0.0, 0.0, 0.0,  //
      0.0, w.x(), 0.0, w.y(), w.z(), 0.0,         //
      0.0, 0.0, w.x(), 0.0, w.y(), w.z();
  return columns;
}

// force (rows 0 to 2) and moment of a link, per number of its LinkVector
using WrenchColumns = Eigen::Matrix<double, 6, numbers_per_link>;

WrenchColumns wrench_columns(LinkMotion const& at) {
  Eigen::Matrix3d const turning = skew(at.omega);
  WrenchColumns columns = WrenchColumns::Zero();
  columns.block<3, 1>(0, 0) = at.acceleration;
  columns.block<3, 3>(0, 1) = skew(at.alpha) + turning * turning;
  columns.block<3, 3>(3, 1) = -skew(at.acceleration);
  columns.block<3, 6>(3, 4) = inertia_columns(at.alpha) + turning * inertia_columns(at.omega);
  return columns;
}

// the same wrenches in the frame before
WrenchColumns carried_inward(FramePose const& pose, WrenchColumns const& columns) {
  WrenchColumns carried;
  carried.topRows<3>() = pose.rotation * columns.topRows<3>();
  carried.bottomRows<3>() = pose.rotation * columns.bottomRows<3>() + skew(pose.position) * carried.topRows<3>();
  return carried;
}

}  // namespace

Eigen::VectorXd inverse_dynamics(SerialChain const& chain, JointVector const& parameters, JointVector const& q,
                                 JointVector const& dq, JointVector const& ddq) {
  Index const n = chain.size(), n_links = numbers_per_link * n;
  TORQUESCOPE_EXPECT(parameters.size() == n_links || parameters.size() == n_links + n);
  auto const motion = outward(chain, q, dq, ddq);
  Eigen::VectorXd tau(n);
  Wrench carried{Vector3d::Zero(), Vector3d::Zero()};
  for (Index i = n - 1; i >= 0; --i) {
    auto const at = static_cast<std::size_t>(i);
    LinkVector const numbers = parameters.segment<numbers_per_link>(numbers_per_link * i);
    Wrench const wrench = needed_wrench(motion[at], LinkInertia::from_vector(numbers)) + carried;
    tau[i] = wrench.along(chain.joints[at].kind);
    carried = wrench.seen_from(motion[at].pose);
  }
  if (parameters.size() > n_links) tau += chain.drive_matrix(parameters.tail(n)) * ddq;
  return tau;
}

Eigen::MatrixXd arm_regressor(SerialChain const& chain, JointVector const& q, JointVector const& dq,
                              JointVector const& ddq, DriveInertias drives) {
  Index const n = chain.size(), n_links = numbers_per_link * n;
  auto const motion = outward(chain, q, dq, ddq);
  Eigen::MatrixXd phi = Eigen::MatrixXd::Zero(n, drives == DriveInertias::included ? n_links + n : n_links);
  for (Index link = 0; link < n; ++link) {
    WrenchColumns columns = wrench_columns(motion[static_cast<std::size_t>(link)]);
    for (Index row = link; row >= 0; --row) {
      auto const at = static_cast<std::size_t>(row);
      Index const component = chain.joints[at].kind == JointKind::revolute ? 5 : 2;
      phi.block<1, numbers_per_link>(row, numbers_per_link * link) = columns.row(component);
      if (row > 0) columns = carried_inward(motion[at].pose, columns);
    }
  }
  if (drives == DriveInertias::included) {
    if (chain.has_coupled_drives())
      phi.rightCols(n) = chain.transmission.transpose() * (chain.transmission * ddq).asDiagonal();
    else
      phi.rightCols(n).diagonal() = ddq;
  }
  return phi;
}

Eigen::VectorXd gravity_torque(SerialChain const& chain, JointVector const& parameters, JointVector const& q) {
  Eigen::VectorXd const still = Eigen::VectorXd::Zero(chain.size());
  return inverse_dynamics(chain, parameters, q, still, still);
}

}  // namespace torquescope
