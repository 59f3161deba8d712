#include "unit/robot/arm_energy.hpp"

#include "engine/base/contract.hpp"
#include "engine/robot/vector3.hpp"

namespace torquescope::test {

namespace {

LinkInertia link_of(JointVector const& parameters, Eigen::Index link) {
  LinkVector const numbers = parameters.segment<numbers_per_link>(numbers_per_link * link);
  return LinkInertia::from_vector(numbers);
}

}  // namespace

double kinetic_energy(SerialChain const& chain, JointVector const& parameters, JointVector const& q,
                      JointVector const& dq) {
  Eigen::Index const n = chain.size(), n_links = numbers_per_link * n;
  TORQUESCOPE_EXPECT(parameters.size() == n_links || parameters.size() == n_links + n);
  double energy = 0.0;
  Eigen::Vector3d v = Eigen::Vector3d::Zero(), w = Eigen::Vector3d::Zero();  // of the link's origin, in its frame
  for (Eigen::Index i = 0; i < n; ++i) {
    auto const& joint = chain.joints[static_cast<std::size_t>(i)];
    auto const pose = joint_pose(joint, q[i]);
    v = pose.rotation.transpose() * (v + cross(w, pose.position));
    w = pose.rotation.transpose() * w;
    (joint.kind == JointKind::revolute ? w : v).z() += dq[i];
    auto const link = link_of(parameters, i);
    energy += 0.5 * link.mass * v.squaredNorm() + v.dot(cross(w, link.first_moment)) + 0.5 * w.dot(link.inertia * w);
  }
  if (parameters.size() > n_links) energy += 0.5 * dq.dot(chain.drive_matrix(parameters.tail(n)) * dq);
  return energy;
}

double potential_energy(SerialChain const& chain, JointVector const& parameters, JointVector const& q) {
  FramePose pose;
  double energy = 0.0;
  for (Eigen::Index i = 0; i < chain.size(); ++i) {
    pose = pose * joint_pose(chain.joints[static_cast<std::size_t>(i)], q[i]);
    auto const link = link_of(parameters, i);
    energy -= chain.gravity.dot(link.mass * pose.position + pose.rotation * link.first_moment);
  }
  return energy;
}

}  // namespace torquescope::test
