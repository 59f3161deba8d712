#include "unit/robot/small_robots.hpp"

#include <fmt/format.h>

#include <array>

namespace torquescope::test {

namespace {

std::string urdf_link(std::string const& name, double mass) {
  if (mass == 0.0) return fmt::format("  <link name=\"{}\"/>\n", name);
  return fmt::format(
      "  <link name=\"{}\">\n    <inertial>\n      <origin xyz=\"0.01 -0.02 0.05\" rpy=\"0 0 0\"/>\n"
      "      <mass value=\"{}\"/>\n"
      "      <inertia ixx=\"0.02\" ixy=\"0.001\" ixz=\"0.0\" iyy=\"0.03\" iyz=\"-0.002\" izz=\"0.02\"/>\n"
      "    </inertial>\n    <visual><geometry><mesh filename=\"package://arm/{}.dae\"/></geometry></visual>\n  "
      "</link>\n",
      name, mass, name);
}

struct UrdfJointText {
  std::string name, type, parent, child, xyz, rpy, rest;
};

std::string urdf_joint(UrdfJointText const& joint) {
  bool const moves = joint.type != "fixed" && joint.type != "floating";
  std::string text = fmt::format(
      "  <joint name=\"{}\" type=\"{}\">\n    <origin xyz=\"{}\" rpy=\"{}\"/>\n    <parent link=\"{}\"/>\n"
      "    <child link=\"{}\"/>\n",
      joint.name, joint.type, joint.xyz, joint.rpy, joint.parent, joint.child);
  if (moves) text += joint.type == "prismatic" ? "    <axis xyz=\"0 1 0\"/>\n" : "    <axis xyz=\"0 0 1\"/>\n";
  if (joint.type == "revolute" || joint.type == "prismatic")
    text += "    <limit lower=\"-2.5\" upper=\"2.5\" effort=\"87\" velocity=\"2.2\"/>\n";
  return text + joint.rest + "  </joint>\n";
}

// joints one behind another along z, each turned by a right angle about x, as files of makers have them
std::string urdf_row(std::size_t n, std::string const& first_link, std::string const& every_second) {
  std::string text, parent = first_link;
  for (std::size_t k = 1; k <= n; ++k) {
    auto const child = fmt::format("link_{}", k);
    char const* const turn = k % 2 == 0 ? "1.5707963 0 0" : k == 1 ? "0 0 0" : "-1.5707963 0 0";
    text += urdf_link(child, 4.0 - 0.4 * static_cast<double>(k)) +
            urdf_joint({fmt::format("joint_{}", k), k % 2 == 1 ? every_second : "revolute", parent, child,
                        k == 1 ? "0 0 0.33" : "0.02 -0.3 0.01", turn, ""});
    parent = child;
  }
  return text;
}

std::string urdf_robot(std::string const& name, std::string const& body) {
  return fmt::format("<?xml version=\"1.0\"?>\n<!-- written by hand -->\n<robot name=\"{}\">\n{}</robot>\n", name,
                     body);
}

}  // namespace

std::string six_joint_urdf() {
  return urdf_robot(
      "six", urdf_link("world", 0) + urdf_link("base_link", 4.0) + urdf_link("flange", 0) + urdf_link("tool0", 0) +
                 urdf_joint({"base_joint", "fixed", "world", "base_link", "0 0 0", "0 0 0", ""}) +
                 urdf_row(6, "base_link", "revolute") +
                 urdf_joint({"to_flange", "fixed", "link_6", "flange", "0 0 0.1", "0 -1.5708 -1.5708", ""}) +
                 urdf_joint({"to_tool", "fixed", "flange", "tool0", "0 0 0", "1.5708 0 1.5708", ""}));
}

std::string hand_urdf() {
  return urdf_robot("hand",
                    urdf_link("link_0", 2.0) + urdf_row(7, "link_0", "revolute") + urdf_link("hand", 0.7) +
                        urdf_link("left", 0.01) + urdf_link("right", 0.01) +
                        urdf_joint({"hand_joint", "fixed", "link_7", "hand", "0 0 0.107", "0 0 -0.785398", ""}) +
                        urdf_joint({"finger_1", "prismatic", "hand", "left", "0 0 0.058", "0 0 0", ""}) +
                        urdf_joint({"finger_2", "prismatic", "hand", "right", "0 0 0.058", "0 0 3.14159265",
                                    "    <mimic joint=\"finger_1\"/>\n"}));
}

std::string continuous_urdf() {
  return urdf_robot("gen", urdf_link("base_link", 1.7) + urdf_row(7, "base_link", "continuous"));
}

std::string quadruped_urdf() {
  std::string text = urdf_link("world", 0) + urdf_link("trunk", 6.9) +
                     urdf_joint({"float", "floating", "world", "trunk", "0 0 0.4", "0 0 0", ""});
  for (auto const& leg : {"FL", "FR", "RL", "RR"}) {
    auto const name = [&](char const* part) { return fmt::format("{}_{}", leg, part); };
    text +=
        urdf_link(name("hip"), 0.7) + urdf_link(name("thigh"), 1.1) + urdf_link(name("calf"), 0.2) +
        urdf_link(name("foot"), 0.04) +
        urdf_joint({name("hip_joint"), "revolute", "trunk", name("hip"), "0.19 0.05 0", "0 1.5707963 0", ""}) +
        urdf_joint({name("thigh_joint"), "revolute", name("hip"), name("thigh"), "0 0.095 0", "1.5707963 0 0", ""}) +
        urdf_joint({name("calf_joint"), "revolute", name("thigh"), name("calf"), "0.213 0 0", "0 0 0", ""}) +
        urdf_joint({name("foot_joint"), "fixed", name("calf"), name("foot"), "0.213 0 0", "0 0 0", ""});
  }
  return urdf_robot("dog", text);
}

std::string jaw_urdf() {
  return urdf_robot("jaw", urdf_link("base", 0.2) + urdf_row(6, "base", "revolute") + urdf_link("gripper_frame", 0) +
                               urdf_joint({"frame", "fixed", "link_5", "gripper_frame", "0 0 0.1", "0 0 0", ""}));
}

std::string hand_mjcf() {
  std::string open, close;
  for (int k = 1; k <= 7; ++k) {
    char const* const turn = k % 2 == 0 ? "1 1 0 0" : k == 1 ? "1 0 0 0" : "1 -1 0 0";
    open += fmt::format(
        "<body name=\"link{0}\" pos=\"{1}\" quat=\"{2}\">\n<inertial mass=\"{3}\" pos=\"0.01 -0.02 0.05\" "
        "fullinertia=\"0.02 0.03 0.02 0.001 0 -0.002\"/>\n<joint name=\"joint{0}\"/>\n"
        "<geom type=\"mesh\" mesh=\"link{0}\" class=\"visual\"/>\n",
        k, k == 1 ? "0 0 0.333" : "0.02 -0.3 0.01", turn, 4.0 - 0.4 * k);
    close += "</body>\n";
  }
  return "<mujoco model=\"hand\">\n<compiler angle=\"radian\" autolimits=\"true\"/>\n<option "
         "integrator=\"implicitfast\"/>\n"
         "<default>\n<default class=\"arm\">\n<joint armature=\"0.1\" damping=\"1\" axis=\"0 0 1\" range=\"-2.9 "
         "2.9\"/>\n"
         "<general dyntype=\"none\" biastype=\"affine\" forcerange=\"-87 87\"/>\n"
         "<default class=\"finger\"><joint axis=\"0 1 0\" type=\"slide\" range=\"0 0.04\"/></default>\n"
         "<default class=\"visual\"><geom type=\"mesh\" contype=\"0\" conaffinity=\"0\" group=\"2\"/></default>\n"
         "</default>\n</default>\n<worldbody>\n<light pos=\"0 0 1\"/>\n<body name=\"link0\" childclass=\"arm\">\n"
         "<inertial mass=\"0.6\" pos=\"0 0 0\" diaginertia=\"0.003 0.004 0.004\"/>\n" +
         open +
         "<body name=\"hand\" pos=\"0 0 0.107\" quat=\"0.9238795 0 0 -0.3826834\">\n"
         "<inertial mass=\"0.73\" pos=\"0 0 0.03\" diaginertia=\"0.001 0.0025 0.0017\"/>\n"
         "<body name=\"left\"><inertial mass=\"0.015\" pos=\"0 0 0\" diaginertia=\"2e-6 2e-6 5e-7\"/>"
         "<joint name=\"finger1\" class=\"finger\"/></body>\n"
         "<body name=\"right\" quat=\"0 0 0 1\"><inertial mass=\"0.015\" pos=\"0 0 0\" diaginertia=\"2e-6 2e-6 5e-7\"/>"
         "<joint name=\"finger2\" class=\"finger\"/></body>\n</body>\n" +
         close +
         "</body>\n</worldbody>\n<equality><joint joint1=\"finger1\" joint2=\"finger2\" solref=\"0.005 "
         "1\"/></equality>\n"
         "<actuator>\n<general class=\"arm\" name=\"a1\" joint=\"joint1\" gainprm=\"4500\"/>\n</actuator>\n</mujoco>\n";
}

std::string seven_joint_mjcf() {
  std::string open, close;
  for (int k = 1; k <= 7; ++k) {
    open += fmt::format(
        "<body name=\"link{0}\" pos=\"0 {1} 0.2\" {2}>\n<inertial mass=\"{3}\" pos=\"0 0.03 0.12\" "
        "diaginertia=\"0.1 0.09 0.02\"/>\n<joint name=\"joint{0}\" class=\"joint{4}\"/>\n",
        k, k == 1 ? "0" : "0.01", k % 2 == 0 ? "euler=\"90 0 180\"" : "axisangle=\"1 0 0 0\"", 5.0 - 0.4 * k,
        k % 2 + 1);
    close += "</body>\n";
  }
  return "<mujoco model=\"seven\">\n<compiler autolimits=\"true\"/>\n<default>\n"
         "<default class=\"iiwa\">\n<joint axis=\"0 0 1\" damping=\"1\"/>\n"
         "<default class=\"joint1\"><joint range=\"-170 170\"/></default>\n"
         "<default class=\"joint2\"><joint range=\"-120 120\"/></default>\n</default>\n</default>\n"
         "<worldbody>\n<body name=\"base\" childclass=\"iiwa\">\n" +
         open + "<site name=\"attachment\" pos=\"0 0 0.045\"/>\n" + close + "</body>\n</worldbody>\n</mujoco>\n";
}

std::string jaw_mjcf() {
  constexpr std::array<char const*, 6> names{"pan", "lift", "elbow", "wrist", "roll", "jaw"};
  std::string open, close, drives;
  for (auto const* name : names) {
    open += fmt::format(
        "<body name=\"{0}_link\" pos=\"0.03 0 0.1\" xyaxes=\"0 1 0 0 0 1\">\n"
        "<joint name=\"{0}\" class=\"servo\" axis=\"0 0 1\" range=\"-1.9 1.9\"/>\n"
        "<inertial pos=\"0.02 0 0.01\" quat=\"0.5 0.5 0.5 0.5\" mass=\"0.1\" diaginertia=\"8e-5 7e-5 5e-5\"/>\n",
        name);
    close += "</body>\n";
    drives += fmt::format("<position name=\"{0}\" joint=\"{0}\" class=\"servo\" ctrlrange=\"-1.9 1.9\"/>\n", name);
  }
  return "<mujoco model=\"jaw\">\n<compiler angle=\"radian\"/>\n<default>\n<default class=\"servo\">\n"
         "<joint damping=\"0.6\" frictionloss=\"0.052\" armature=\"0.028\"/>\n"
         "<position kp=\"17.8\" forcerange=\"-3.35 3.35\"/>\n</default>\n</default>\n<worldbody>\n<body "
         "name=\"base\">\n" +
         open + close + "</body>\n</worldbody>\n<actuator>\n" + drives + "</actuator>\n</mujoco>\n";
}

std::string quadruped_mjcf() {
  std::string legs, drives;
  for (auto const& leg : {"FL", "FR", "RL", "RR"}) {
    legs += fmt::format(
        "<body name=\"{0}_hip\" pos=\"0.19 0.05 0\">\n<inertial mass=\"0.7\" pos=\"0 0 0\" diaginertia=\"1e-3 1e-3 "
        "1e-3\"/>\n"
        "<joint name=\"{0}_hip_joint\" axis=\"1 0 0\"/>\n<body name=\"{0}_thigh\" pos=\"0 0.095 0\">\n"
        "<inertial mass=\"1.1\" pos=\"0 0 -0.03\" diaginertia=\"6e-3 6e-3 1e-3\"/>\n"
        "<joint name=\"{0}_thigh_joint\"/>\n<body name=\"{0}_calf\" pos=\"0 0 -0.213\">\n"
        "<inertial mass=\"0.24\" pos=\"0 0 -0.1\" diaginertia=\"1e-3 1e-3 4e-5\"/>\n"
        "<joint name=\"{0}_calf_joint\"/>\n<geom name=\"{0}\" type=\"sphere\" size=\"0.022\" pos=\"0 0 -0.213\"/>\n"
        "</body>\n</body>\n</body>\n",
        leg);
    drives += fmt::format("<motor joint=\"{0}_hip_joint\" ctrlrange=\"-23.7 23.7\"/>\n", leg);
  }
  return "<mujoco model=\"dog\">\n<compiler angle=\"radian\"/>\n<default><default class=\"leg\">"
         "<joint axis=\"0 1 0\" damping=\"0.1\" armature=\"0.01\" "
         "frictionloss=\"0.2\"/></default></default>\n<worldbody>\n"
         "<geom type=\"plane\" size=\"0 0 0.05\"/>\n<body name=\"trunk\" pos=\"0 0 0.445\" childclass=\"leg\">\n"
         "<inertial mass=\"6.9\" pos=\"0.02 0 0\" diaginertia=\"0.1 0.1 0.1\"/>\n<freejoint/>\n" +
         legs + "</body>\n</worldbody>\n<actuator>\n" + drives + "</actuator>\n</mujoco>\n";
}

}  // namespace torquescope::test
