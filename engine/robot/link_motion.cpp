#include "engine/robot/link_motion.hpp"

#include "engine/base/contract.hpp"
#include "engine/robot/vector3.hpp"

namespace torquescope {

using Eigen::Vector3d;

void move_outward(SerialChain const& chain, Eigen::Ref<Eigen::VectorXd const> const& dq,
                  Eigen::Ref<Eigen::VectorXd const> const& ddq, std::span<LinkMotion> links) {
  TORQUESCOPE_EXPECT(links.size() == chain.joints.size() && dq.size() == chain.size() && ddq.size() == chain.size());
  Vector3d const joint_axis{0.0, 0.0, 1.0};
  LinkMotion before;
  before.acceleration = -chain.gravity;
  for (std::size_t i = 0; i < links.size(); ++i) {
    auto& link = links[i];
    double const speed = dq[static_cast<Eigen::Index>(i)], push = ddq[static_cast<Eigen::Index>(i)];
    Eigen::Matrix3d const into = link.pose.rotation.transpose();
    Vector3d const& p = link.pose.position;
    link.omega = into * before.omega;
    link.alpha = into * before.alpha;
    link.acceleration =
        into * (before.acceleration + cross(before.alpha, p) + cross(before.omega, cross(before.omega, p)));
    if (chain.joints[i].kind == JointKind::revolute) {
      link.alpha += cross(link.omega, speed * joint_axis) + push * joint_axis;
      link.omega += speed * joint_axis;
    } else {
      link.acceleration += 2.0 * cross(link.omega, speed * joint_axis) + push * joint_axis;
    }
    before = link;
  }
}

Wrench Wrench::seen_from(FramePose const& pose) const {
  Wrench seen;
  seen.force = pose.rotation * force;
  seen.moment = pose.rotation * moment + cross(pose.position, seen.force);
  return seen;
}

Wrench needed_wrench(LinkMotion const& at, LinkInertia const& link) {
  Vector3d const& h = link.first_moment;
  Vector3d const& w = at.omega;
  return {link.mass * at.acceleration + cross(at.alpha, h) + cross(w, cross(w, h)),
          link.inertia * at.alpha + cross(w, link.inertia * w) + cross(h, at.acceleration)};
}

}  // namespace torquescope
