#include "engine/robot/mjcf_drives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/robot/xml_words.hpp"

namespace torquescope {

namespace {

TreeJoint& joint_named(RobotTree& tree, XmlElement const& element, char const* attribute) {
  std::string const& name = *element.find(attribute);
  std::vector<std::string> names;
  for (auto& [child, joint] : tree.joint_to) {
    if (joint.motion == JointMotion::fixed) continue;
    if (joint.joint.name == name) return joint;
    names.push_back(joint.joint.name);
  }
  auto const close = closest_name(name, names);
  refuse_mjcf(
      element.place_of(attribute), fmt::format("no joint is called \"{}\"", name),
      close.empty() ? fmt::format("joints: {}", fmt::join(names, ", ")) : fmt::format("did you mean \"{}\"?", close));
}

std::optional<double> widest(XmlElement const& element, char const* range, char const* is_limited) {
  auto const numbers = numbers_of(element, range, 2, 2);
  if (word_of(element, is_limited, {"auto", "true", "false"}, "auto") == "false" || !numbers) return std::nullopt;
  double const size = std::max(std::abs((*numbers)[0]), std::abs((*numbers)[1]));
  return size > 0.0 ? std::optional(size) : std::nullopt;
}

void read_actuator(MjcfDocument const& document, XmlElement const& given, RobotTree& tree) {
  auto const whole = document.with_defaults(given, "");
  char const* const key = whole.find("joint") != nullptr ? "joint" : "jointinparent";
  if (whole.find(key) == nullptr) return;  // of a tendon or a site
  auto& joint = joint_named(tree, whole, key);
  if (joint.motion != JointMotion::moves) return;
  auto const gears = numbers_of(whole, "gear", 1, 6);
  double const gear = gears ? std::abs(gears->front()) : 1.0;
  auto const control = widest(whole, "ctrlrange", "ctrllimited");
  auto const force = widest(whole, "forcerange", "forcelimited");
  bool const is_motor = whole.name == "motor";
  if (force)
    joint.joint.max_torque = std::min(joint.joint.max_torque, gear * *force);
  else if (is_motor && control)
    joint.joint.max_torque = std::min(joint.joint.max_torque, gear * *control);
  if (gear == 1.0 || gear == 0.0) return;
  if (is_motor && control == 1.0) {
    joint.effects.push_back(fmt::format("gear {:g} of a control from -1 to 1, taken as its greatest torque", gear));
    return;
  }
  joint.joint.gear_ratio = gear;
}

void read_equality(XmlElement const& given, RobotTree& tree) {
  if (!is_true(given, "active", true)) return;
  if (given.name == "connect" || given.name == "weld")
    tree.warnings.push_back(
        fmt::format("{}: <{}> closes a loop, which the model does not have", place_text(given.place()), given.name));
  if (given.name != "joint" || given.find("joint1") == nullptr) return;
  JointCoupling coupling{joint_named(tree, given, "joint1").joint.name, "", given.place()};
  if (given.find("joint2") != nullptr) coupling.second = joint_named(tree, given, "joint2").joint.name;
  tree.couplings.push_back(std::move(coupling));
}

}  // namespace

void read_mjcf_drives(MjcfDocument const& document, RobotTree& tree) {
  for (auto const* section : document.sections("actuator"))
    for (auto const& one : section->children) read_actuator(document, one, tree);
  for (auto const* section : document.sections("equality"))
    for (auto const& one : section->children) read_equality(one, tree);
}

}  // namespace torquescope
