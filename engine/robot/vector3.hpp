#pragma once
// The vector product without Eigen's geometry module, which every file would compile.

#include <Eigen/Core>

namespace torquescope {

// skew(a) * b = a x b
inline Eigen::Matrix3d skew(Eigen::Vector3d const& a) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return matrix;
}

inline Eigen::Vector3d cross(Eigen::Vector3d const& a, Eigen::Vector3d const& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

}  // namespace torquescope
