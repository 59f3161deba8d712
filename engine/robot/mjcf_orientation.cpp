#include "engine/robot/mjcf_orientation.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cctype>
#include <cmath>

namespace torquescope {

namespace {

constexpr double no_length = 1e-10;

Eigen::Matrix3d turned(Eigen::Vector3d const& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

Eigen::Matrix3d of_quaternion(std::vector<double> const& q) {
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

Eigen::Matrix3d of_euler(std::vector<double> const& angles, MjcfCompiler const& compiler) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  for (std::size_t k = 0; k < 3; ++k) {
    char const letter = compiler.euler_sequence[k];
    bool const turns_with_frame = std::islower(static_cast<unsigned char>(letter)) != 0;
    auto const axis = std::tolower(static_cast<unsigned char>(letter)) - 'x';
    Eigen::Matrix3d const one = turned(Eigen::Vector3d::Unit(axis), compiler.radians * angles[k]);
    rotation = turns_with_frame ? Eigen::Matrix3d(rotation * one) : Eigen::Matrix3d(one * rotation);
  }
  return rotation;
}

// y is made perpendicular to x
Eigen::Matrix3d of_axes(Eigen::Vector3d const& x_given, Eigen::Vector3d const& y_given) {
  Eigen::Vector3d const x = x_given.normalized();
  Eigen::Vector3d const y = (y_given - x.dot(y_given) * x).normalized();
  Eigen::Matrix3d rotation;
  rotation << x, y, x.cross(y);
  return rotation;
}

}  // namespace

Eigen::Matrix3d turn_of_z_onto(Eigen::Vector3d const& direction) {
  Eigen::Vector3d const onto = direction.normalized(), across = Eigen::Vector3d::UnitZ().cross(onto);
  // straight down: half a turn about x, as MuJoCo does it
  if (onto.z() < -1.0 + Eigen::NumTraits<double>::dummy_precision()) return Eigen::Vector3d(1, -1, -1).asDiagonal();
  double const twice_cosine = std::sqrt(2.0 * (1.0 + onto.z()));
  Eigen::Vector3d const axis = across / twice_cosine;
  return Eigen::Quaterniond(0.5 * twice_cosine, axis.x(), axis.y(), axis.z()).toRotationMatrix();
}

Eigen::Matrix3d mjcf_rotation(XmlElement const& element, MjcfCompiler const& compiler) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  int found = 0;
  std::string_view name;
  bool is_sound = true;
  auto const read = [&](std::string_view attribute, std::size_t count) {
    auto numbers = numbers_of(element, attribute, count, count);
    if (numbers) {
      ++found;
      name = attribute;
    }
    return numbers;
  };
  if (auto const q = read("quat", 4)) {
    is_sound = Eigen::Vector4d::Map(q->data()).norm() > no_length;
    rotation = of_quaternion(*q);
  }
  if (auto const angles = read("euler", 3)) rotation = of_euler(*angles, compiler);
  if (auto const turn = read("axisangle", 4)) {
    Eigen::Vector3d const axis = Eigen::Vector3d::Map(turn->data());
    is_sound = axis.norm() > no_length;
    rotation = turned(axis.normalized(), compiler.radians * (*turn)[3]);
  }
  if (auto const axes = read("xyaxes", 6)) {
    Eigen::Vector3d const x = Eigen::Vector3d::Map(axes->data()), y = Eigen::Vector3d::Map(axes->data() + 3);
    is_sound = x.cross(y).norm() > no_length;
    rotation = of_axes(x, y);
  }
  if (auto const z = read("zaxis", 3)) {
    Eigen::Vector3d const axis = Eigen::Vector3d::Map(z->data());
    is_sound = axis.norm() > no_length;
    rotation = turn_of_z_onto(axis);
  }
  if (found > 1)
    refuse_mjcf(element.place(), fmt::format("<{}> has {} orientations", element.name, found),
                "keep one of quat, euler, axisangle, xyaxes and zaxis");
  if (!is_sound)
    refuse_mjcf(element.place_of(name), fmt::format("{} of <{}> has no direction", name, element.name),
                "write the direction, for example quat=\"1 0 0 0\"");
  return rotation;
}

}  // namespace torquescope
