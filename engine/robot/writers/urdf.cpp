// Robot files in URDF: each joint turns or slides along the z axis of a frame of its own.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/robot/robot_writers.hpp"
#include "engine/robot/urdf_limits.hpp"
#include "engine/robot/vector3.hpp"
#include "engine/robot/written_text.hpp"

namespace torquescope::writers {

namespace {

constexpr double gravity_of_readers = 9.81;  // m/s^2; a URDF says no other
constexpr std::string_view no_place[] = {"gear_ratio", "drive_inertia", "encoder_counts", "max_acceleration"};

// fixed-axis angles; yaw first, so that none is lost where pitch is a right angle
Eigen::Vector3d roll_pitch_yaw(Eigen::Matrix3d const& rotation) {
  double const yaw = std::atan2(rotation(1, 0), rotation(0, 0));
  Eigen::Matrix3d const rest = Eigen::AngleAxisd(-yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix() * rotation;
  return {std::atan2(-rest(1, 2), rest(1, 1)), std::atan2(-rest(2, 0), rest(0, 0)), yaw};
}

std::string origin_text(FramePose const& pose) {
  return fmt::format("<origin xyz=\"{}\" rpy=\"{}\"/>", numbers_text(pose.position, " "),
                     numbers_text(roll_pitch_yaw(pose.rotation), " "));
}

std::string link_text(std::string const& name, LinkInertia const* link) {
  if (link == nullptr) return fmt::format("  <link name=\"{}\"/>\n", xml_text(name));
  auto const body = centred_body(*link);
  auto const& t = body.inertia;
  return fmt::format("  <link name=\"{}\">\n    <inertial>\n      <origin xyz=\"{}\" rpy=\"0 0 0\"/>\n", xml_text(name),
                     numbers_text(body.centre, " ")) +
         fmt::format("      <mass value=\"{}\"/>\n", number_text(body.mass)) +
         fmt::format("      <inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" izz=\"{}\"/>\n",
                     number_text(t[0]), number_text(t[1]), number_text(t[2]), number_text(t[3]), number_text(t[4]),
                     number_text(t[5])) +
         "    </inertial>\n  </link>\n";
}

std::string limit_text(ChainJoint const& joint) {
  bool const slides = joint.kind == JointKind::prismatic;
  bool const has_range = slides || is_limited(joint);
  if (!has_range && !std::isfinite(joint.max_torque) && !std::isfinite(joint.max_speed)) return "";
  auto const given = [](double value) {
    return number_text(std::isfinite(value) ? value : std::copysign(urdf_unlimited, value));
  };
  std::string const range =
      has_range ? fmt::format("lower=\"{}\" upper=\"{}\" ", given(joint.lower), given(joint.upper)) : "";
  return fmt::format("    <limit {}effort=\"{}\" velocity=\"{}\"/>\n", range, given(joint.max_torque),
                     given(joint.max_speed));
}

bool has_unknown_limit(ChainJoint const& joint) {
  return limit_text(joint).find(number_text(urdf_unlimited)) != std::string::npos;
}

std::string joint_text(ChainJoint const& joint, FramePose const& origin, std::string const& parent,
                       std::string const& child) {
  bool const slides = joint.kind == JointKind::prismatic;
  std::string const type = slides ? "prismatic" : is_limited(joint) ? "revolute" : "continuous";
  return fmt::format("  <joint name=\"{}\" type=\"{}\">\n    <parent link=\"{}\"/>\n    <child link=\"{}\"/>\n",
                     xml_text(joint.name), type, parent, child) +
         fmt::format("    {}\n    <axis xyz=\"0 0 1\"/>\n{}  </joint>\n", origin_text(origin), limit_text(joint));
}

// the shortest turn of one direction onto another
Eigen::Matrix3d turn_onto(Eigen::Vector3d const& from, Eigen::Vector3d const& onto) {
  constexpr double opposite = 1e-12;
  double const cosine = from.dot(onto);
  if (cosine > opposite - 1.0) {
    double const twice = std::sqrt(2.0 * (1.0 + cosine));
    Eigen::Vector3d const axis = cross(from, onto) / twice;
    return Eigen::Quaterniond(0.5 * twice, axis.x(), axis.y(), axis.z()).toRotationMatrix();
  }
  Eigen::Vector3d across = Eigen::Vector3d::Zero();
  across[std::abs(from.x()) < 0.9 ? 0 : 1] = 1.0;
  Eigen::Vector3d const axis = (across - from.dot(across) * from).normalized();
  return 2.0 * axis * axis.transpose() - Eigen::Matrix3d::Identity();  // half a turn about anything across
}

// frame 0 as it stood in the robot's own file when gravity points down there, else turned until it does
FramePose standing(SerialChain const& chain) {
  double const size = chain.gravity.norm();
  Eigen::Vector3d const down(0.0, 0.0, -1.0);
  FramePose pose = chain.base;
  if (size == 0.0 || (pose.rotation * chain.gravity - size * down).norm() <= 1e-12 * size) return pose;
  pose.rotation = turn_onto(chain.gravity / size, down);
  return pose;
}

std::string write(SerialChain const& chain, std::vector<std::string> const& notes) {
  std::string text = "<?xml version=\"1.0\"?>\n";
  for (auto const& note : notes) text += xml_comment(note);
  text += xml_comment(
      "A URDF holds no gear ratios, drive inertias, encoders and accelerations: write them in a TOML file.");
  for (auto const& joint : chain.joints) text += lost_numbers(joint, no_place);
  if (std::any_of(chain.joints.begin(), chain.joints.end(), has_unknown_limit))
    text += xml_comment(
        fmt::format("{:g} as an effort, a velocity or an end of a slide: that limit is not known.", urdf_unlimited));
  if (double const size = chain.gravity.norm(); std::abs(size - gravity_of_readers) > 1e-9)
    text += xml_comment(fmt::format("Gravity was {} m/s^2, and a URDF cannot say so: tell your program.", size));
  text += fmt::format("<robot name=\"{}\">\n  <link name=\"base_link\"/>\n", xml_text(chain.name));
  FramePose before = standing(chain);
  std::string parent = "base_link";
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    std::string const child = fmt::format("link_{}", i + 1);
    text += link_text(child, chain.has_inertias() ? &chain.links[i] : nullptr);
    text += joint_text(chain.joints[i], before * joint_pose(chain.joints[i], 0.0), parent, child);
    before = FramePose{};
    parent = child;
  }
  text += fmt::format("  <link name=\"tool0\"/>\n  <joint name=\"tool0_fixed\" type=\"fixed\">\n");
  text += fmt::format("    <parent link=\"{}\"/>\n    <child link=\"tool0\"/>\n    {}\n  </joint>\n</robot>\n", parent,
                      origin_text(chain.flange));
  return text;
}

}  // namespace

RobotWriter urdf() { return {"urdf", "Unified Robot Description Format, as ROS reads it", false, write}; }

}  // namespace torquescope::writers
