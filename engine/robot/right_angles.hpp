#pragma once
// Angles that are meant to be right ones. Files write pi/2 as 1.5708 or 1.57; taken literally, such an arm has base
// parameters that no recording can tell apart, because they differ by the rounding of an angle alone.
//
// Threads    pure functions

#include <Eigen/Core>
#include <string>
#include <vector>

namespace torquescope {

inline constexpr double right_angle_tolerance = 1e-3;  // rad
inline constexpr double rounding_of_an_angle = 1e-7;   // rad: smaller changes are not worth a remark

// the multiple of pi/2 within the tolerance, else the angle itself
double nearest_right_angle(double angle);

// the same for a rotation matrix: an axis of one frame along one of the other, and the angle about it
Eigen::Matrix3d nearest_right_angles(Eigen::Matrix3d const& rotation);

// the same with a remark where it is worth one; whose: "joint \"elbow\""
Eigen::Matrix3d right_or_as_written(Eigen::Matrix3d const& rotation, std::string const& whose,
                                    std::vector<std::string>& remarks);

}  // namespace torquescope
