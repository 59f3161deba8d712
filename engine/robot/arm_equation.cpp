#include "engine/robot/arm_equation.hpp"

#include "engine/base/contract.hpp"
#include "engine/robot/vector3.hpp"
#include "kernels/elementary.hpp"

namespace torquescope {

using Eigen::Index;

namespace {

// needed at the link's origin to give the joint unit acceleration while nothing moves
Wrench of_unit_acceleration(LinkInertia const& body, JointKind kind) {
  Eigen::Vector3d const axis{0.0, 0.0, 1.0};
  if (kind == JointKind::revolute) return {cross(axis, body.first_moment), body.inertia * axis};
  return {body.mass * axis, cross(body.first_moment, axis)};
}

}  // namespace

ArmEquation::ArmEquation(SerialChain const& chain, JointVector const& parameters)
    : chain_(chain),
      drives_(Eigen::MatrixXd::Zero(chain.size(), chain.size())),
      still_(Eigen::VectorXd::Zero(chain.size())),
      cos_alpha_(chain.joints.size()),
      sin_alpha_(chain.joints.size()),
      angle_(chain.joints.size()),
      cosine_(chain.joints.size()),
      sine_(chain.joints.size()),
      motion_(chain.joints.size()),
      mass_(chain.size(), chain.size()),
      bias_(chain.size()) {
  Index const n = size(), n_links = numbers_per_link * n;
  TORQUESCOPE_EXPECT(parameters.size() == n_links || parameters.size() == n_links + n);
  for (Index i = 0; i < n; ++i) {
    LinkVector const numbers = parameters.segment<numbers_per_link>(numbers_per_link * i);
    links_.push_back(LinkInertia::from_vector(numbers));
  }
  if (parameters.size() > n_links) drives_ = chain.drive_matrix(parameters.tail(n));
  composite_ = links_;
  std::vector<double> alpha;
  for (auto const& joint : chain.joints) alpha.push_back(joint.alpha);
  kernels::cosine_sine_of_multiple(1.0, alpha.data(), alpha.size(), cos_alpha_.data(), sin_alpha_.data());
}

void ArmEquation::set(JointVector const& q, JointVector const& dq) {
  TORQUESCOPE_EXPECT(q.size() == size() && dq.size() == size());
  set_poses(q);
  set_mass();
  set_bias(dq);
}

void ArmEquation::set_poses(JointVector const& q) {
  auto const turns = [&](std::size_t i) { return chain_.joints[i].kind == JointKind::revolute; };
  for (std::size_t i = 0; i < angle_.size(); ++i)
    angle_[i] = chain_.joints[i].offset + (turns(i) ? q[static_cast<Index>(i)] : 0.0);
  kernels::cosine_sine_of_multiple(1.0, angle_.data(), angle_.size(), cosine_.data(), sine_.data());
  for (std::size_t i = 0; i < motion_.size(); ++i) {
    double const d = chain_.joints[i].d + (turns(i) ? 0.0 : q[static_cast<Index>(i)]);
    motion_[i].pose = dh_pose({cos_alpha_[i], sin_alpha_[i]}, {cosine_[i], sine_[i]}, chain_.joints[i].a, d);
  }
}

void ArmEquation::set_mass() {
  composite_ = links_;
  for (std::size_t i = composite_.size() - 1; i > 0; --i)
    composite_[i - 1] = composite_[i - 1] + composite_[i].seen_from(motion_[i].pose);
  for (Index column = 0; column < size(); ++column) {
    auto at = static_cast<std::size_t>(column);
    Wrench wrench = of_unit_acceleration(composite_[at], chain_.joints[at].kind);
    mass_(column, column) = wrench.along(chain_.joints[at].kind) + drives_(column, column);
    for (Index row = column - 1; row >= 0; --row) {
      wrench = wrench.seen_from(motion_[static_cast<std::size_t>(row) + 1].pose);
      mass_(row, column) = wrench.along(chain_.joints[static_cast<std::size_t>(row)].kind) + drives_(row, column);
      mass_(column, row) = mass_(row, column);
    }
  }
}

void ArmEquation::set_bias(JointVector const& dq) {
  move_outward(chain_, dq, still_, motion_);
  Wrench carried;
  for (Index i = size() - 1; i >= 0; --i) {
    auto const at = static_cast<std::size_t>(i);
    Wrench const wrench = needed_wrench(motion_[at], links_[at]) + carried;
    bias_[i] = wrench.along(chain_.joints[at].kind);
    carried = wrench.seen_from(motion_[at].pose);
  }
}

}  // namespace torquescope
