#include "engine/robot/link_inertia.hpp"

#include <cmath>

#include "engine/base/contract.hpp"
#include "engine/robot/vector3.hpp"

namespace torquescope {

namespace {

// inertia of a point mass at `at`, per kilogram
Eigen::Matrix3d point_inertia(Eigen::Vector3d const& at) {
  return at.squaredNorm() * Eigen::Matrix3d::Identity() - at * at.transpose();
}

}  // namespace

FramePose FramePose::operator*(FramePose const& inner) const {
  return {rotation * inner.rotation, position + rotation * inner.position};
}

FramePose FramePose::inverse() const { return {rotation.transpose(), -(rotation.transpose() * position)}; }

LinkInertia LinkInertia::from_vector(LinkVector const& numbers) {
  LinkInertia link;
  link.mass = numbers[0];
  link.first_moment = numbers.segment<3>(1);
  link.inertia << numbers[4], numbers[5], numbers[6],  //
      numbers[5], numbers[7], numbers[8],              //
      numbers[6], numbers[8], numbers[9];
  return link;
}

LinkInertia LinkInertia::from_centre(double mass, Eigen::Vector3d const& centre, Eigen::Matrix3d const& about_centre) {
  return {mass, mass * centre, about_centre + mass * point_inertia(centre)};
}

LinkVector LinkInertia::vector() const {
  LinkVector numbers;
  numbers << mass, first_moment, inertia(0, 0), inertia(0, 1), inertia(0, 2), inertia(1, 1), inertia(1, 2),
      inertia(2, 2);
  return numbers;
}

// with r the frame's position and h the turned first moment, the tensor about the new origin gains
// m (r.r 1 - r r') + 2 (r.h) 1 - r h' - h r'
LinkInertia LinkInertia::seen_from(FramePose const& pose) const {
  Eigen::Matrix3d const& turn = pose.rotation;
  Eigen::Vector3d const& r = pose.position;
  Eigen::Vector3d const h = turn * first_moment;
  Eigen::Matrix3d const moved = 2.0 * r.dot(h) * Eigen::Matrix3d::Identity() - r * h.transpose() - h * r.transpose();
  return {mass, h + mass * r, turn * inertia * turn.transpose() + mass * point_inertia(r) + moved};
}

LinkInertia LinkInertia::operator+(LinkInertia const& other) const {
  return {mass + other.mass, first_moment + other.first_moment, inertia + other.inertia};
}

Eigen::Matrix3d LinkInertia::about_centre() const {
  TORQUESCOPE_EXPECT(mass > 0.0);
  return inertia - mass * point_inertia(first_moment / mass);
}

std::string body_fault(LinkInertia const& link) {
  if (!(link.mass > 0.0)) return "has no mass";
  // second moments about the centre: a covariance, so no principal minor is negative
  Eigen::Matrix3d const about = link.about_centre();
  double const size = about.trace(), allowed = 1e-6;
  if (size == 0.0) return about.isZero() ? "" : "is not positive";
  Eigen::Matrix3d const moments = (0.5 * size * Eigen::Matrix3d::Identity() - about) / std::abs(size);
  if (moments.diagonal().minCoeff() < -allowed)
    return "breaks the triangle inequality: one of xx, yy, zz exceeds the sum of the others";
  for (int i = 0; i < 3; ++i) {
    int const j = (i + 1) % 3;
    if (moments(i, i) * moments(j, j) - moments(i, j) * moments(i, j) < -allowed)
      return "has a product of inertia that is too large for a body";
  }
  double const volume = moments.row(0).dot(cross(moments.row(1), moments.row(2)));
  return volume < -allowed ? "belongs to no body: a principal moment exceeds the sum of the others" : "";
}

}  // namespace torquescope
