#include "engine/robot/serial_chain.hpp"

#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {

Eigen::MatrixXd SerialChain::drive_matrix(Eigen::Ref<Eigen::VectorXd const> const& inertias) const {
  if (!has_coupled_drives()) return inertias.asDiagonal();
  return transmission.transpose() * inertias.asDiagonal() * transmission;
}

FramePose joint_pose(ChainJoint const& joint, double q) {
  bool const turns = joint.kind == JointKind::revolute;
  double const theta = joint.offset + (turns ? q : 0.0), d = joint.d + (turns ? 0.0 : q);
  return dh_pose({std::cos(joint.alpha), std::sin(joint.alpha)}, {std::cos(theta), std::sin(theta)}, joint.a, d);
}

FramePose dh_pose(CosineSine alpha, CosineSine theta, double a, double d) {
  auto const [ca, sa] = alpha;
  auto const [ct, st] = theta;
  FramePose pose;
  pose.rotation << ct, -st, 0.0,  //
      ca * st, ca * ct, -sa,      //
      sa * st, sa * ct, ca;
  pose.position << a, -sa * d, ca * d;
  return pose;
}

Eigen::VectorXd standard_parameters(SerialChain const& chain, DriveInertias drives) {
  TORQUESCOPE_EXPECT(chain.links.size() == chain.joints.size());
  Eigen::Index const n = chain.size(), n_links = numbers_per_link * n;
  Eigen::VectorXd parameters(drives == DriveInertias::included ? n_links + n : n_links);
  for (Eigen::Index i = 0; i < n; ++i)
    parameters.segment<numbers_per_link>(numbers_per_link * i) = chain.links[static_cast<std::size_t>(i)].vector();
  if (drives == DriveInertias::included)
    for (Eigen::Index i = 0; i < n; ++i)
      parameters[n_links + i] = chain.joints[static_cast<std::size_t>(i)].drive_inertia;
  return parameters;
}

std::vector<std::string> standard_names(SerialChain const& chain, DriveInertias drives) {
  std::vector<std::string> names;
  for (std::size_t i = 1; i <= chain.joints.size(); ++i)
    for (auto const& number : link_number_names) names.push_back(std::string(number) + std::to_string(i));
  if (drives == DriveInertias::included)
    for (std::size_t i = 1; i <= chain.joints.size(); ++i) names.push_back("drive_" + std::to_string(i));
  return names;
}

}  // namespace torquescope
