#pragma once
// The two passes of the recursive Newton-Euler method, link by link: motion outwards, forces inwards.
//
// Frames     all of a link is along its own frame's axes, at its origin; pose: seen from the link before
// Units      SI
// Threads    values; no allocation
// Source     Khalil and Dombre 2002, section 9.5; Luh, Walker, Paul 1980, doi:10.1115/1.3149599

#include <Eigen/Core>
#include <span>

#include "engine/robot/serial_chain.hpp"

namespace torquescope {

struct LinkMotion {
  FramePose pose{};
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();         // rad/s
  Eigen::Vector3d alpha = Eigen::Vector3d::Zero();         // rad/s^2
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // m/s^2 of the origin; gravity is one of the base, upwards
};

// the poses are set; N links
void move_outward(SerialChain const& chain, Eigen::Ref<Eigen::VectorXd const> const& dq,
                  Eigen::Ref<Eigen::VectorXd const> const& ddq, std::span<LinkMotion> links);

struct Wrench {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();  // on the link, at its origin

  Wrench operator+(Wrench const& other) const { return {force + other.force, moment + other.moment}; }
  // the part that the joint's motor gives
  double along(JointKind kind) const { return kind == JointKind::revolute ? moment.z() : force.z(); }
  // in the frame that `pose` is seen from
  Wrench seen_from(FramePose const& pose) const;
};

Wrench needed_wrench(LinkMotion const& at, LinkInertia const& link);

}  // namespace torquescope
