// Robot files in MJCF, MuJoCo's own format: drive inertias are armatures, gravity is told.
//
// Source     MuJoCo documentation, XML reference: body, inertial, joint

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "engine/robot/robot_writers.hpp"
#include "engine/robot/vector3.hpp"
#include "engine/robot/written_text.hpp"

namespace torquescope::writers {

namespace {

constexpr std::string_view no_place[] = {"gear_ratio", "encoder_counts", "max_speed", "max_acceleration", "max_torque"};

std::string pose_text(FramePose const& pose) {
  Eigen::Quaterniond const turn = Eigen::Quaterniond(pose.rotation).normalized();
  Eigen::Vector4d const numbers(turn.w(), turn.x(), turn.y(), turn.z());
  return fmt::format("pos=\"{}\" quat=\"{}\"", numbers_text(pose.position, " "), numbers_text(numbers, " "));
}

// along principal axes: MuJoCo 2.2 finds those of a full tensor to eight digits only
std::string inertial_text(LinkInertia const& link) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> const axes(link.about_centre());
  Eigen::Matrix3d turn = axes.eigenvectors();
  if (cross(turn.col(0), turn.col(1)).dot(turn.col(2)) < 0.0) turn.col(0) = -turn.col(0);
  Eigen::Vector3d const& moments = axes.eigenvalues();
  return fmt::format("<inertial {} mass=\"{}\" diaginertia=\"{}\"/>", pose_text({turn, link.first_moment / link.mass}),
                     number_text(link.mass), numbers_text(moments, " "));
}

std::string body_text(ChainJoint const& joint, LinkInertia const& link, FramePose const& pose, std::size_t number) {
  std::string const indent(4 + 2 * (number - 1), ' ');
  std::string range;
  if (is_limited(joint))
    range = fmt::format(" limited=\"true\" range=\"{} {}\"", number_text(joint.lower), number_text(joint.upper));
  return fmt::format("{}<body name=\"link_{}\" {}>\n{}  {}\n", indent, number, pose_text(pose), indent,
                     inertial_text(link)) +
         fmt::format("{}  <joint name=\"{}\" type=\"{}\" axis=\"0 0 1\" armature=\"{}\"{}/>\n", indent,
                     xml_text(joint.name), joint.kind == JointKind::revolute ? "hinge" : "slide",
                     number_text(joint.drive_inertia), range);
}

std::string write(SerialChain const& chain, std::vector<std::string> const& notes) {
  std::string text;
  for (auto const& note : notes) text += xml_comment(note);
  for (auto const& joint : chain.joints) text += lost_numbers(joint, no_place);
  text += fmt::format("<mujoco model=\"{}\">\n  <compiler angle=\"radian\"/>\n", xml_text(chain.name));
  text += fmt::format("  <option gravity=\"{}\"/>\n  <worldbody>\n",
                      numbers_text(chain.base.rotation * chain.gravity, " "));
  FramePose before = chain.base;
  std::size_t const n = chain.joints.size();
  for (std::size_t i = 0; i < n; ++i) {
    text += body_text(chain.joints[i], chain.links[i], before * joint_pose(chain.joints[i], 0.0), i + 1);
    before = FramePose{};
  }
  text += fmt::format("{}<site name=\"tool0\" {}/>\n", std::string(4 + 2 * n, ' '), pose_text(chain.flange));
  for (std::size_t i = n; i > 0; --i) text += std::string(2 + 2 * i, ' ') + "</body>\n";
  return text + "  </worldbody>\n</mujoco>\n";
}

}  // namespace

RobotWriter mjcf() { return {"mjcf", "MuJoCo's format", true, write}; }

}  // namespace torquescope::writers
