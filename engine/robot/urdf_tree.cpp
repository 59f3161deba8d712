#include "engine/robot/urdf_tree.hpp"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "engine/robot/right_angles.hpp"
#include "engine/robot/urdf_limits.hpp"
#include "engine/robot/urdf_words.hpp"
#include "engine/robot/xml_words.hpp"

namespace torquescope {

namespace {

constexpr double most_angle = 20.0 * std::numbers::pi;  // ten turns; limits in degrees are above
constexpr double unit_tolerance = 1e-3;
constexpr double farthest_origin = 20.0;  // m, as the DH numbers of a robot in TOML

// what urdfdom says while it reads
class Listener final : public console_bridge::OutputHandler {
 public:
  Listener() { console_bridge::useOutputHandler(this); }
  ~Listener() override { console_bridge::restorePreviousOutputHandler(); }
  Listener(Listener const&) = delete;
  Listener& operator=(Listener const&) = delete;
  void log(std::string const& text, console_bridge::LogLevel level, char const*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR) return;
    if (first_error.empty()) first_error = text;
    // urdfdom reads on without it: a typing error would become a link without a mass
    if (inertial_error.empty() && text.find("nertia") != std::string::npos) inertial_error = text;
  }
  std::string first_error;
  std::string inertial_error;
};

Eigen::Vector3d vector_of(urdf::Vector3 const& v) { return {v.x, v.y, v.z}; }

Eigen::Matrix3d matrix_of(urdf::Rotation const& q) {
  Eigen::Matrix3d matrix;
  matrix << 1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y - q.w * q.z), 2.0 * (q.x * q.z + q.w * q.y),
      2.0 * (q.x * q.y + q.w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z), 2.0 * (q.y * q.z - q.w * q.x),
      2.0 * (q.x * q.z - q.w * q.y), 2.0 * (q.y * q.z + q.w * q.x), 1.0 - 2.0 * (q.x * q.x + q.y * q.y);
  return matrix;
}

XmlElement const* urdf_element(XmlElement const& robot, std::string const& element, std::string const& name) {
  for (auto const& one : robot.children)
    if (auto const* const called = one.find("name"); one.name == element && called != nullptr && *called == name)
      return &one;
  return nullptr;
}

// where <joint name="elbow"> or <link name="forearm"> begins, or where <axis of it does
SourcePlace urdf_place(XmlElement const& robot, std::string const& element, std::string const& name,
                       std::string const& inner = "") {
  auto const* const found = urdf_element(robot, element, name);
  if (found == nullptr) return robot.text->whole();
  auto const* const within = inner.empty() ? nullptr : found->child(inner);
  return within == nullptr ? found->place() : within->place();
}

// the part of a message in [brackets] or (parentheses) is a name or a value: its place
SourcePlace place_of_message(XmlElement const& xml, std::string const& message) {
  auto const& text = *xml.text;
  std::vector<std::string> pieces;
  for (std::size_t open = message.find_first_of("[("); open != std::string::npos;
       open = message.find_first_of("[(", open + 1))
    pieces.push_back(message.substr(open + 1, message.find_first_of("])", open) - open - 1));
  for (auto const& piece : pieces)
    for (auto const* element : {"joint", "link", "material"})
      if (auto place = urdf_place(xml, element, piece); place.line > 0) return place;
  for (auto const& piece : pieces)
    for (char const* before : {"\"", "'", " "})
      if (auto const at = text.text.find(before + piece); !piece.empty() && at != std::string::npos)
        return text.place(at + 1, piece.size());
  return text.whole();
}

// Links own their children: those of a loop would keep one another for ever
class ParsedModel {
 public:
  explicit ParsedModel(urdf::ModelInterfaceSharedPtr model) : model_(std::move(model)) {}
  ~ParsedModel() {
    for (auto const& [name, link] : model_->links_) {
      link->child_links.clear();
      link->child_joints.clear();
    }
  }
  ParsedModel(ParsedModel const&) = delete;
  ParsedModel& operator=(ParsedModel const&) = delete;
  urdf::ModelInterface const& operator*() const { return *model_; }

 private:
  urdf::ModelInterfaceSharedPtr model_;
};

ParsedModel parse(RobotText const& text, XmlElement const& xml) {
  Listener listener;
  auto model = urdf::parseURDF(text.text);
  validate(model != nullptr && listener.inertial_error.empty(), [&] {
    Problem problem;
    problem.code = ExitCode::bad_data;
    std::string const& said = model == nullptr ? listener.first_error : listener.inertial_error;
    problem.what = "this is no URDF" + (said.empty() ? "" : ": " + said);
    problem.place = place_of_message(xml, said);
    problem.help = "mend it there; check_urdf (Debian: liburdfdom-tools) reads it the same way";
    return problem;
  });
  return ParsedModel(std::move(model));
}

class TreeReader {
 public:
  TreeReader(XmlElement const& xml, urdf::ModelInterface const& model) : xml_(xml), model_(model) {}

  RobotTree read() {
    tree_.name = model_.getName();
    tree_.root = model_.getRoot()->name;
    for (auto const& [name, link] : model_.links_)
      if (link->inertial) read_inertia(*link);
    for (auto const& [name, joint] : model_.joints_) read_joint(*joint);
    refuse_loops();
    warn_of_missing_leaders();
    if (!problems_.empty()) throw Error(std::move(problems_));
    return std::move(tree_);
  }

 private:
  void refuse(SourcePlace place, std::string what, std::string help) {
    problems_.push_back({.what = std::move(what), .place = std::move(place), .help = std::move(help)});
  }

  void read_inertia(urdf::Link const& link) {
    auto const& given = *link.inertial;
    Eigen::Matrix3d tensor;
    tensor << given.ixx, given.ixy, given.ixz, given.ixy, given.iyy, given.iyz, given.ixz, given.iyz, given.izz;
    FramePose const pose{matrix_of(given.origin.rotation), vector_of(given.origin.position)};
    auto const body = LinkInertia::from_centre(given.mass, Eigen::Vector3d::Zero(), tensor);
    if (!(given.mass >= 0.0) || !tensor.allFinite()) {
      refuse(urdf_place(xml_, "link", link.name, "inertial"),
             fmt::format("link \"{}\" has mass {} and an inertia that is none", link.name, given.mass),
             "write its mass in kg and its inertia in kg m^2, or no <inertial> at all");
      return;
    }
    if (given.mass == 0.0 && tensor.isZero()) return;
    if (auto const fault = body_fault(body); !fault.empty())
      tree_.remarks.push_back(fmt::format("the inertia of link \"{}\" {}", link.name, fault));
    tree_.inertias[link.name] = body.seen_from(pose);
  }

  void read_joint(urdf::Joint const& given) {
    TreeJoint read;
    read.joint.name = given.name;
    read.parent = given.parent_link_name;
    read.child = given.child_link_name;
    read.origin = origin_of(given, read.remarks);
    read.place = urdf_place(xml_, "joint", given.name);
    read.motion = motion_of(given);
    if (given.mimic) {
      read.mimics = given.mimic->joint_name;
      read.place = urdf_place(xml_, "joint", given.name, "mimic");
    }
    if (read.motion == JointMotion::moves) read_motion(given, read);
    if (tree_.joint_to.contains(read.child)) {
      refuse(urdf_place(xml_, "joint", given.name),
             fmt::format("link \"{}\" hangs on two joints, \"{}\" and \"{}\": a loop", read.child,
                         tree_.joint_to[read.child].joint.name, given.name),
             "a serial arm has no loops: take one of the two joints out");
      return;
    }
    tree_.children[read.parent].push_back(read.child);
    tree_.joint_to[read.child] = std::move(read);
  }

  static JointMotion motion_of(urdf::Joint const& given) {
    switch (given.type) {
      case urdf::Joint::FIXED:
        return JointMotion::fixed;
      case urdf::Joint::REVOLUTE:
      case urdf::Joint::CONTINUOUS:
      case urdf::Joint::PRISMATIC:
        return JointMotion::moves;
      default:
        return JointMotion::floats;
    }
  }

  // urdfdom has turned them into a rotation: the text itself tells degrees
  void refuse_degrees(urdf::Joint const& given) {
    auto const* const joint = urdf_element(xml_, "joint", given.name);
    auto const* const origin = joint == nullptr ? nullptr : joint->child("origin");
    auto const* const rpy = origin == nullptr ? nullptr : origin->find("rpy");
    if (rpy == nullptr) return;
    SourcePlace const place = origin->place_of("rpy");
    std::istringstream numbers(*rpy);
    for (double angle = 0.0; numbers >> angle;) {
      if (std::abs(angle) <= 2.0 * std::numbers::pi + unit_tolerance) continue;
      refuse(place, fmt::format("rpy of joint \"{}\" has an angle of {}: is it in degrees?", given.name, angle),
             fmt::format("write radians: {} degrees are {:.10g}", angle, angle * std::numbers::pi / 180.0));
      return;
    }
  }

  FramePose origin_of(urdf::Joint const& given, std::vector<std::string>& remarks) {
    auto const at = vector_of(given.parent_to_joint_origin_transform.position);
    if (double const farthest = at.cwiseAbs().maxCoeff(); !(farthest <= farthest_origin))
      refuse(urdf_place(xml_, "joint", given.name, "origin"),
             fmt::format("joint \"{}\" is {:.4g} m from its parent: is it in millimetres?", given.name, farthest),
             fmt::format("write metres: {:.4g} mm are {:.4g} m", farthest, 1e-3 * farthest));
    refuse_degrees(given);
    auto const& origin = given.parent_to_joint_origin_transform;
    return {right_or_as_written(matrix_of(origin.rotation), fmt::format("joint \"{}\"", given.name), remarks),
            vector_of(origin.position)};
  }

  void read_motion(urdf::Joint const& given, TreeJoint& read) {
    auto& joint = read.joint;
    joint.kind = given.type == urdf::Joint::PRISMATIC ? JointKind::prismatic : JointKind::revolute;
    read.axis = vector_of(given.axis);
    double const length = read.axis.norm();
    if (!(length > 0.0) || !std::isfinite(length)) {
      refuse(urdf_place(xml_, "joint", given.name, "axis"),
             fmt::format("the axis of joint \"{}\" has length {:.4g}", given.name, length),
             "write the direction of the axis, for example <axis xyz=\"0 0 1\"/>");
      return;
    }
    if (std::abs(length - 1.0) > unit_tolerance)
      read.remarks.push_back(
          fmt::format("{}: the axis of joint \"{}\" has length {:.4g}; its direction is taken, as ROS does",
                      place_text(urdf_place(xml_, "joint", given.name, "axis")), given.name, length));
    read.axis /= length;
    if (given.dynamics) {
      if (given.dynamics->damping != 0.0) read.effects.push_back(fmt::format("damping {:g}", given.dynamics->damping));
      if (given.dynamics->friction != 0.0)
        read.effects.push_back(fmt::format("friction {:g}", given.dynamics->friction));
    }
    if (!given.limits) return;
    bool const bounded = given.type != urdf::Joint::CONTINUOUS;
    if (bounded && given.limits->lower > -urdf_unlimited) joint.lower = given.limits->lower;
    if (bounded && given.limits->upper < urdf_unlimited) joint.upper = given.limits->upper;
    auto const is_known = [](double most) { return most > 0.0 && most < urdf_unlimited; };
    if (is_known(given.limits->velocity)) joint.max_speed = given.limits->velocity;
    if (is_known(given.limits->effort)) joint.max_torque = given.limits->effort;
    double const widest = std::max(std::abs(given.limits->lower), std::abs(given.limits->upper));
    if (bounded && joint.kind == JointKind::revolute && widest > most_angle)
      refuse(urdf_place(xml_, "joint", given.name, "limit"),
             fmt::format("joint \"{}\" has a limit of {} rad: is it in degrees?", given.name, widest),
             fmt::format("write radians: {} degrees are {:.10g}", widest, widest * std::numbers::pi / 180.0));
  }

  // urdfdom takes any name for the joint that another one follows
  void warn_of_missing_leaders() {
    for (auto const& [child, joint] : tree_.joint_to)
      if (!joint.mimics.empty() && !model_.joints_.contains(joint.mimics))
        tree_.warnings.push_back(fmt::format("{}: joint \"{}\" follows \"{}\", and no joint is called so",
                                             place_text(joint.place), joint.joint.name, joint.mimics));
  }

  // every joint must be reached from the root
  void refuse_loops() {
    for (auto const& [child, joint] : tree_.joint_to) {
      std::string link = child;
      std::size_t steps = 0;
      while (link != tree_.root && tree_.joint_to.contains(link) && steps <= tree_.joint_to.size()) {
        link = tree_.joint_to.at(link).parent;
        ++steps;
      }
      if (steps <= tree_.joint_to.size()) continue;
      refuse(urdf_place(xml_, "joint", joint.joint.name),
             fmt::format("joint \"{}\" is part of a loop that does not begin at the base", joint.joint.name),
             "a serial arm has no loops: every link but the base has one parent, and the base has none");
      return;
    }
  }

  XmlElement const& xml_;
  urdf::ModelInterface const& model_;
  RobotTree tree_;
  std::vector<Problem> problems_;
};

}  // namespace

RobotTree read_urdf_tree(RobotText const& text) {
  auto const xml = read_xml(std::make_shared<RobotText const>(text), "URDF");
  auto const model = parse(text, xml);
  auto tree = TreeReader(xml, *model).read();
  for (auto& sentence : unknown_words(xml, urdf_words())) tree.warnings.push_back(std::move(sentence));
  return tree;
}

}  // namespace torquescope
