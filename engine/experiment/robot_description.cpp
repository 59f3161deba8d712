#include "engine/experiment/robot_description.hpp"

#include <cmath>
#include <limits>

#include "engine/robot/base_parameters.hpp"
#include "engine/robot/gather_text.hpp"
#include "engine/robot/robot_registry.hpp"

namespace torquescope {

namespace {

constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

double given_or_nan(double value) { return std::isinf(value) ? not_given : value; }

// what rounding leaves of a zero is zero
double without_rounding(double value) { return std::abs(value) < 1e-12 ? 0.0 : value; }

std::vector<double> list_of(Eigen::Vector3d const& v) {
  return {without_rounding(v.x()), without_rounding(v.y()), without_rounding(v.z())};
}

RobotDescription::Joint described_joint(ChainJoint const& joint) {
  RobotDescription::Joint text;
  text.name = joint.name;
  text.kind = joint.kind == JointKind::revolute ? "revolute" : "prismatic";
  text.alpha = without_rounding(joint.alpha);
  text.a = without_rounding(joint.a);
  text.offset = without_rounding(joint.offset);
  text.d = without_rounding(joint.d);
  text.lower = given_or_nan(joint.lower);
  text.upper = given_or_nan(joint.upper);
  text.max_speed = given_or_nan(joint.max_speed);
  text.max_acceleration = given_or_nan(joint.max_acceleration);
  text.max_torque = given_or_nan(joint.max_torque);
  text.gear_ratio = joint.gear_ratio == 1.0 ? not_given : joint.gear_ratio;
  text.drive_inertia = joint.drive_inertia == 0.0 ? not_given : joint.drive_inertia;
  return text;
}

}  // namespace

RobotDescription describe_robot(std::filesystem::path const& file, RobotPart const& part) {
  auto const chain = read_robot(file, part);
  BaseParameters const base(chain, DriveInertias::included);
  RobotDescription robot;
  robot.name = chain.name;
  robot.gravity = list_of(chain.gravity);
  robot.base = list_of(chain.base.position);
  robot.flange = list_of(chain.flange.position);
  for (auto const& joint : chain.joints) robot.joints.push_back(described_joint(joint));
  robot.has_inertias = chain.has_inertias();
  for (auto const& link : chain.links) robot.mass += link.mass;
  for (Eigen::Index k = 0; k < base.size(); ++k) {
    auto const& parameter = base.parameters()[static_cast<std::size_t>(k)];
    robot.parameters.push_back({parameter.name, gather_text(base, k), parameter.unit});
  }
  robot.standard_parameters = static_cast<int>(numbers_per_link * chain.size());
  robot.rigid_parameters = static_cast<int>(BaseParameters(chain, DriveInertias::left_out).size());
  robot.without_effect = base.without_effect();
  robot.remarks = chain.remarks;
  robot.warnings = chain.warnings;
  return robot;
}

}  // namespace torquescope
