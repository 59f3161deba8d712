#include "engine/robot/right_angles.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace torquescope {

double nearest_right_angle(double angle) {
  double const right = std::numbers::pi / 2.0, nearest = right * std::round(angle / right);
  return std::abs(angle - nearest) <= right_angle_tolerance ? nearest : angle;
}

Eigen::Matrix3d nearest_right_angles(Eigen::Matrix3d const& rotation) {
  Eigen::Index row = 0, column = 0;
  double const largest = rotation.cwiseAbs().maxCoeff(&row, &column);
  if (largest < std::cos(right_angle_tolerance)) return rotation;
  // the other two rows and columns, each in cyclic order, turn by one angle (mirrored when the axis is reversed)
  double const sign = rotation(row, column) < 0.0 ? -1.0 : 1.0;
  Eigen::Index const r1 = (row + 1) % 3, r2 = (row + 2) % 3, c1 = (column + 1) % 3, c2 = (column + 2) % 3;
  double const angle = nearest_right_angle(
      std::atan2(rotation(r2, c1) - sign * rotation(r1, c2), rotation(r1, c1) + sign * rotation(r2, c2)));
  double const quarters = angle / (std::numbers::pi / 2.0), whole = std::round(quarters);
  bool const exact = std::abs(quarters - whole) < 1e-12;
  double const c = exact ? std::round(std::cos(angle)) : std::cos(angle);
  double const s = exact ? std::round(std::sin(angle)) : std::sin(angle);
  Eigen::Matrix3d turned = Eigen::Matrix3d::Zero();
  turned(row, column) = sign;
  turned(r1, c1) = c;
  turned(r2, c1) = s;
  turned(r1, c2) = -sign * s;
  turned(r2, c2) = sign * c;
  return turned;
}

Eigen::Matrix3d right_or_as_written(Eigen::Matrix3d const& rotation, std::string const& whose,
                                    std::vector<std::string>& remarks) {
  Eigen::Matrix3d right = nearest_right_angles(rotation);
  double const change = (rotation - right).cwiseAbs().maxCoeff();
  if (change > rounding_of_an_angle)
    remarks.push_back(
        fmt::format("the angles of {} are taken as right ones, {:.1e} rad from what is written", whose, change));
  return right;
}

}  // namespace torquescope
