#include "engine/robot/mjcf_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "engine/robot/mjcf_drives.hpp"
#include "engine/robot/mjcf_inertia.hpp"
#include "engine/robot/mjcf_words.hpp"
#include "engine/robot/right_angles.hpp"

namespace torquescope {

namespace {

constexpr double most_turns_rad = 20.0 * std::numbers::pi;  // ten turns; limits in degrees are above
constexpr double widest_doubtful = 2.0 * std::numbers::pi;  // ends of ranges in radians are below
constexpr double farthest_body = 20.0;                      // m, as the origins of a URDF
constexpr char const* world = "world";

class MjcfTreeReader {
 public:
  explicit MjcfTreeReader(MjcfDocument const& document) : document_(document) {}

  RobotTree read() {
    auto const* const model = document_.root().find("model");
    tree_.name = model == nullptr ? "" : *model;
    tree_.root = world;
    links_.insert(world);
    read_options();
    for (auto const* section : document_.sections("worldbody")) read_bodies(*section, {world, FramePose{}, ""});
    doubt_degrees();
    return std::move(tree_);
  }

 private:
  // where the children of an element hang
  struct Around {
    std::string link;
    FramePose pose;  // of the element, seen from the link
    std::string childclass;
  };

  void read_options() {
    for (auto const* option : document_.sections("option")) {
      if (auto const gravity = numbers_of(*option, "gravity", 3, 3))
        tree_.gravity = Eigen::Vector3d::Map(gravity->data());
      if (auto const* const flag = option->child("flag"); flag != nullptr)
        if (word_of(*flag, "gravity", {"enable", "disable"}, "enable") == "disable") tree_.gravity.setZero();
    }
    for (auto const* compiler : document_.sections("compiler"))
      for (char const* const key : {"settotalmass", "boundmass", "boundinertia"})
        if (number_of(*compiler, key, 0.0) > 0.0)
          tree_.warnings.push_back(
              fmt::format("{}: {} is not applied to the masses", place_text(compiler->place_of(key)), key));
  }

  // the format begins with degrees, and people forget it: no arm turns by three of them
  void doubt_degrees() {
    if (widest_hinge_ == 0.0 || widest_hinge_ > widest_doubtful) return;
    for (auto const* compiler : document_.sections("compiler"))
      if (compiler->find("angle") != nullptr) return;
    tree_.warnings.push_back(
        fmt::format("{}: no <compiler angle> is written, so angles are degrees, and no hinge turns by more than {:g} "
                    "degrees; where they are radians write <compiler angle=\"radian\"/>",
                    place_text(document_.root().place()), widest_hinge_));
  }

  std::string new_name(std::set<std::string>& taken, XmlElement const& element, std::string const& otherwise) {
    auto const* const written = element.find("name");
    std::string name = written != nullptr && !written->empty() ? *written : "";
    if (name.empty())
      for (std::size_t k = 1; name.empty() || taken.contains(name); ++k) name = fmt::format("{}_{}", otherwise, k);
    if (!taken.insert(name).second)
      refuse_mjcf(element.place_of("name"), fmt::format("two of <{}> are called \"{}\"", element.name, name),
                  "give each a name of its own");
    return name;
  }

  void read_bodies(XmlElement const& element, Around const& around) {
    constexpr std::string_view made_by_mujoco[] = {"replicate", "attach", "composite", "flexcomp"};
    for (auto const& child : element.children) {
      auto const* const own = child.find("childclass");
      std::string const childclass = own == nullptr ? around.childclass : *own;
      if (std::find(std::begin(made_by_mujoco), std::end(made_by_mujoco), child.name) != std::end(made_by_mujoco))
        refuse_mjcf(child.place(), fmt::format("<{}> is made into bodies by MuJoCo alone", child.name),
                    "have MuJoCo write the file out, and use that: mujoco.mj_saveLastXML(\"whole.xml\", model)");
      if (child.name == "frame") read_bodies(child, {around.link, around.pose * pose_of(child), childclass});
      if (child.name == "body") read_body(child, {around.link, around.pose * pose_of(child), childclass});
    }
  }

  FramePose pose_of(XmlElement const& element) {
    auto pose = document_.pose_of(element);
    if (double const farthest = pose.position.cwiseAbs().maxCoeff(); !(farthest <= farthest_body))
      refuse_mjcf(element.place_of("pos"),
                  fmt::format("<{}> is {:.4g} m from its parent: is it in millimetres?", element.name, farthest),
                  fmt::format("write metres: {:.4g} mm are {:.4g} m", farthest, 1e-3 * farthest));
    auto const* const name = element.find("name");
    pose.rotation = right_or_as_written(pose.rotation,
                                        fmt::format("{} \"{}\"", element.name, name == nullptr ? "" : *name), remarks_);
    return pose;
  }

  void read_body(XmlElement const& body, Around const& around) {
    std::string const name = new_name(links_, body, "body");
    read_joints(body, name, around);
    auto const inertia = mjcf_inertia(document_, body, around.childclass);
    if (inertia.body) {
      if (auto const fault = body_fault(*inertia.body); !fault.empty())
        tree_.remarks.push_back(
            fmt::format("{}: the inertia of body \"{}\" {}", place_text(body.place()), name, fault));
      tree_.inertias[name] = *inertia.body;
    }
    if (!inertia.unknown.empty()) tree_.unknown_inertias[name] = inertia.unknown;
    if (number_of(body, "gravcomp", 0.0) != 0.0)
      tree_.warnings.push_back(fmt::format("{}: gravcomp of body \"{}\" is not part of the model",
                                           place_text(body.place_of("gravcomp")), name));
    read_bodies(body, {name, FramePose{}, around.childclass});
  }

  void hang(TreeJoint joint) {
    tree_.children[joint.parent].push_back(joint.child);
    auto const child = joint.child;
    joint.remarks = std::exchange(remarks_, {});
    tree_.joint_to[child] = std::move(joint);
  }

  static TreeJoint link_between(std::string parent, std::string child, FramePose const& origin, XmlElement const& at) {
    TreeJoint joint;
    joint.joint.name = child;
    joint.parent = std::move(parent);
    joint.child = std::move(child);
    joint.origin = origin;
    joint.place = at.place();
    return joint;
  }

  // what moves a body, seen from `around`: nothing, one joint, or several with frames between them
  void read_joints(XmlElement const& body, std::string const& name, Around const& around) {
    std::vector<XmlElement const*> joints;
    for (auto const& child : body.children)
      if (child.name == "joint" || child.name == "freejoint") joints.push_back(&child);
    std::string above = around.link;
    FramePose origin = around.pose;
    for (std::size_t k = 0; k < joints.size(); ++k) {
      auto const whole = document_.with_defaults(*joints[k], around.childclass);
      FramePose anchor;
      if (auto const at = numbers_of(whole, "pos", 3, 3)) anchor.position = Eigen::Vector3d::Map(at->data());
      bool const is_last = k + 1 == joints.size(), is_body = is_last && anchor.position.isZero();
      auto joint = link_between(above, is_body ? name : fmt::format("{}/{}", name, k + 1), origin * anchor, whole);
      read_joint(whole, joint);
      joint.is_part_of_one = !is_last;
      above = joint.child;
      origin = anchor.inverse();
      hang(std::move(joint));
    }
    if (above != name) hang(link_between(above, name, origin, body));
  }

  void read_joint(XmlElement const& given, TreeJoint& read) {
    read.joint.name = new_name(joint_names_, given, "joint");
    std::string const type =
        given.name == "freejoint" ? "free" : word_of(given, "type", {"hinge", "slide", "ball", "free"}, "hinge");
    if (type == "free" || type == "ball") {
      read.motion = JointMotion::floats;
      return;
    }
    read.motion = JointMotion::moves;
    read.joint.kind = type == "slide" ? JointKind::prismatic : JointKind::revolute;
    read.axis = Eigen::Vector3d::UnitZ();
    if (auto const axis = numbers_of(given, "axis", 3, 3)) read.axis = Eigen::Vector3d::Map(axis->data());
    double const length = read.axis.norm();
    if (!(length > 0.0))
      refuse_mjcf(given.place_of("axis"), fmt::format("the axis of joint \"{}\" has length 0", read.joint.name),
                  "write the direction of the axis, for example axis=\"0 0 1\"");
    read.axis /= length;
    double const unit = type == "hinge" ? document_.compiler().radians : 1.0;
    read.position_of_file = unit * number_of(given, "ref", 0.0);
    read.joint.drive_inertia = number_of(given, "armature", 0.0);
    read_limits(given, unit, read);
    for (char const* const key : {"damping", "frictionloss", "stiffness"})
      if (auto const numbers = numbers_of(given, key, 1, 3); numbers && numbers->front() != 0.0)
        read.effects.push_back(fmt::format("{} {}", key, *given.find(key)));
  }

  void read_limits(XmlElement const& given, double unit, TreeJoint& read) {
    auto const limited = word_of(given, "limited", {"auto", "true", "false"}, "auto");
    bool const is_limited = limited == "auto" ? document_.compiler().are_ranges_limits : limited == "true";
    auto const range = numbers_of(given, "range", 2, 2);
    if (range && is_limited && (*range)[0] < (*range)[1]) {
      read.joint.lower = unit * (*range)[0];
      read.joint.upper = unit * (*range)[1];
      double const widest = std::max(std::abs(read.joint.lower), std::abs(read.joint.upper));
      if (read.joint.kind == JointKind::revolute) widest_hinge_ = std::max(widest_hinge_, widest / unit);
      if (read.joint.kind == JointKind::revolute && widest > most_turns_rad)
        refuse_mjcf(given.place_of("range"),
                    fmt::format("joint \"{}\" has a range of {} rad: is it in degrees?", read.joint.name, widest),
                    "write <compiler angle=\"degree\"/>, or the range in radians");
    }
    if (auto const force = numbers_of(given, "actuatorfrcrange", 2, 2))
      read.joint.max_torque = std::max(std::abs((*force)[0]), std::abs((*force)[1]));
  }

  MjcfDocument const& document_;
  RobotTree tree_;
  std::set<std::string> links_, joint_names_;
  double widest_hinge_ = 0.0;         // end of a range, as it is written
  std::vector<std::string> remarks_;  // of the poses before the next link
};

}  // namespace

RobotTree read_mjcf_tree(RobotText const& text) {
  MjcfDocument const document(text);
  auto tree = MjcfTreeReader(document).read();
  read_mjcf_drives(document, tree);
  for (auto& sentence : unknown_words(document.root(), mjcf_words())) tree.warnings.push_back(std::move(sentence));
  return tree;
}

}  // namespace torquescope
