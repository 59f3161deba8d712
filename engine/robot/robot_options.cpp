#include "engine/robot/robot_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace torquescope {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
constexpr double most_turns = 10.0;  // of a joint; its limits in degrees are more than that many radians
constexpr double infinite = ChainJoint::no_limit;

void refuse(Section const& section, std::string const& key, std::string what, std::string help,
            std::vector<Problem>& problems) {
  problems.push_back(problem_at(section, key, std::move(what), std::move(help)));
}

void refuse_degrees(Section const& section, std::string const& key, double value, double most,
                    std::vector<Problem>& problems) {
  if (!section.find(key) || std::abs(value) <= most * (1.0 + 1e-6)) return;
  refuse(section, key, fmt::format("{} = {} is more than {:.3g} rad: is it in degrees?", key, value, most),
         fmt::format("write radians: {} degrees are {}", value, value * std::numbers::pi / 180.0), problems);
}

void refuse_length(Section const& section, std::string const& key, std::size_t wanted, std::size_t given,
                   char const* example, std::vector<Problem>& problems) {
  if (!section.find(key) || given == wanted) return;
  refuse(section, key, fmt::format("{} holds {} numbers, not {}", key, given, wanted),
         fmt::format("write {} = {}", key, example), problems);
}

void check_inertia(Section const& section, JointOptions const& options, std::vector<Problem>& problems) {
  bool const has_body = section.find("centre_m") || section.find("inertia_kgm2");
  if (has_body && !section.find("mass_kg")) {
    refuse(section, "centre_m",
           fmt::format("joint \"{}\" has a centre of mass or an inertia, but no mass", options.name),
           "write mass_kg as well, or leave all three out: identification needs none of them", problems);
  } else if (section.find("mass_kg") && !(section.find("centre_m") && section.find("inertia_kgm2"))) {
    refuse(section, "mass_kg",
           fmt::format("joint \"{}\" has a mass, but not both centre_m and inertia_kgm2", options.name),
           "write all three: centre_m = [x, y, z], inertia_kgm2 = [xx, xy, xz, yy, yz, zz] about the centre", problems);
  } else if (auto const link = link_of(options)) {
    if (auto const fault = body_fault(*link); !fault.empty())
      refuse(
          section, "inertia_kgm2", fmt::format("the inertia of joint \"{}\" {}", options.name, fault),
          "inertia_kgm2 is the tensor about the centre of mass: xx, xy, xz, yy, yz, zz with xy = - integral of x y dm",
          problems);
  }
}

}  // namespace

OptionTable<RobotOptions> const& RobotOptions::table() {
  static OptionTable<RobotOptions> const table(
      "robot", "a serial arm: its base, its convention",
      {{"name", &RobotOptions::name, "what people call it"},
       {"convention",
        &RobotOptions::convention,
        {"modified_dh", "standard_dh"},
        "modified_dh: Rx(alpha) Tx(a) Rz(q + offset) Tz(d); standard_dh: Rz(q + offset) Tz(d) Tx(a) Rx(alpha)"},
       {"gravity", &RobotOptions::gravity, "m/s^2", -30.0, 30.0, "gravity in the base frame: [x, y, z]"},
       {"flange_m", &RobotOptions::flange_m, "m", -100.0, 100.0, "origin of the tool in the last frame: [x, y, z]"},
       {"urdf", &RobotOptions::urdf,
        "URDF, xacro or MJCF with frames and inertias; [[joint]] then adds drives by name"},
       {"root", &RobotOptions::root,
        "link of the urdf that stands still, where its base floats; all before it is held"},
       {"tip", &RobotOptions::tip, "link of the urdf where the arm ends, where it has grippers or branches"}});
  return table;
}

OptionTable<JointOptions> const& JointOptions::table() {
  static OptionTable<JointOptions> const table(
      "joint", "one joint and the link behind it, from the base to the tip",
      {{"name", &JointOptions::name, "what people call it"},
       {"type", &JointOptions::type, {"revolute", "prismatic"}, "turns about its axis, or slides along it"},
       {"a_m", &JointOptions::a_m, "m", -20.0, 20.0, "distance along x"},
       {"alpha_rad", &JointOptions::alpha_rad, "angle about x, in rad; within 1e-3 of a right angle it is one"},
       {"d_m", &JointOptions::d_m, "m", -20.0, 20.0, "distance along z"},
       {"offset_rad", &JointOptions::offset_rad, "angle about z at q = 0, in rad"},
       {"lower", &JointOptions::lower, "least position, in rad (m)"},
       {"upper", &JointOptions::upper, "greatest position, in rad (m)"},
       {"max_speed", &JointOptions::max_speed, "rad/s (m/s)", 0.0, infinite, "speed limit"},
       {"max_acceleration", &JointOptions::max_acceleration, "rad/s^2 (m/s^2)", 0.0, infinite, "acceleration limit"},
       {"max_torque", &JointOptions::max_torque, "N m (N)", 0.0, infinite, "torque limit at the joint"},
       {"gear_ratio", &JointOptions::gear_ratio, "1", 1e-6, 1e6, "motor turns per joint turn (rad per m)"},
       {"drive_inertia", &JointOptions::drive_inertia, "kg m^2 (kg)", 0.0, 1e6,
        "rotor inertia x gear_ratio^2: at the joint; 0: unknown"},
       {"encoder_counts", &JointOptions::encoder_counts, "1", 0.0, 1e9,
        "counts per motor turn, lines times four (per m of a slide); 0: unknown"},
       {"mass_kg", &JointOptions::mass_kg, "kg", 1e-9, 1e5, "mass of the link; identification needs none"},
       {"centre_m", &JointOptions::centre_m, "m", -100.0, 100.0, "centre of mass in the link's frame: [x, y, z]"},
       {"inertia_kgm2", &JointOptions::inertia_kgm2, "kg m^2", -1e6, 1e6,
        "about the centre of mass: [xx, xy, xz, yy, yz, zz]"}});
  return table;
}

JointOptions read_joint_options(Section const& section, std::vector<Problem>& problems) {
  JointOptions options;
  std::size_t const before = problems.size();
  JointOptions::table().apply(section, options, problems);
  refuse_degrees(section, "alpha_rad", options.alpha_rad, full_turn, problems);
  refuse_degrees(section, "offset_rad", options.offset_rad, full_turn, problems);
  if (options.type == "revolute") {
    refuse_degrees(section, "lower", options.lower, most_turns * full_turn, problems);
    refuse_degrees(section, "upper", options.upper, most_turns * full_turn, problems);
  }
  if (options.lower >= options.upper)
    refuse(section, "upper", fmt::format("lower = {} is not below upper = {}", options.lower, options.upper),
           "exchange the two, or leave them out where the joint has no limits", problems);
  refuse_length(section, "centre_m", 3, options.centre_m.size(), "[0.0, 0.01, 0.2]", problems);
  refuse_length(section, "inertia_kgm2", 6, options.inertia_kgm2.size(), "[0.1, 0.0, 0.0, 0.1, 0.0, 0.02]", problems);
  if (problems.size() == before) check_inertia(section, options, problems);
  return options;
}

void apply_drive(Section const& section, JointOptions const& options, ChainJoint& joint) {
  auto const set = [&](char const* key, double value, double& member) {
    if (section.find(key)) member = value;
  };
  set("lower", options.lower, joint.lower);
  set("upper", options.upper, joint.upper);
  set("max_speed", options.max_speed, joint.max_speed);
  set("max_acceleration", options.max_acceleration, joint.max_acceleration);
  set("max_torque", options.max_torque, joint.max_torque);
  set("gear_ratio", options.gear_ratio, joint.gear_ratio);
  set("drive_inertia", options.drive_inertia, joint.drive_inertia);
  if (options.encoder_counts > 0.0)
    joint.encoder_step = joint.kind == JointKind::revolute ? full_turn / (options.encoder_counts * joint.gear_ratio)
                                                           : 1.0 / options.encoder_counts;
}

std::optional<LinkInertia> link_of(JointOptions const& options) {
  if (options.mass_kg <= 0.0 || options.centre_m.size() != 3 || options.inertia_kgm2.size() != 6) return std::nullopt;
  auto const& t = options.inertia_kgm2;
  Eigen::Matrix3d tensor;
  tensor << t[0], t[1], t[2], t[1], t[3], t[4], t[2], t[4], t[5];
  return LinkInertia::from_centre(options.mass_kg, Eigen::Vector3d::Map(options.centre_m.data()), tensor);
}

}  // namespace torquescope
