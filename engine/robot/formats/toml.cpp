// Robot files in TOML: Denavit-Hartenberg numbers, or a URDF, xacro or MJCF with drives added to it.
//
// Errors     Error 78: every unknown key, wrong number and missing mass of the file at once, with places

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/toml_sections.hpp"
#include "engine/robot/right_angles.hpp"
#include "engine/robot/robot_options.hpp"
#include "engine/robot/robot_registry.hpp"
#include "engine/robot/standard_dh.hpp"

namespace torquescope::formats {

namespace {

// one [robot], then its joints
struct RobotSections {
  Section robot{};
  std::vector<Section> joints{};
  std::vector<JointOptions> joint_options{};
  RobotOptions options{};
};

TomlDialect const& dialect() {
  static TomlDialect const robot{.noun = "robot",
                                 .repeated = {"joint"},
                                 .section_example = "a robot is written [robot], each of its joints [[joint]]",
                                 .where_to_read = "      (torquescope describe robot)"};
  return robot;
}

RobotSections read_sections(RobotText const& text, std::vector<Problem>& problems) {
  RobotSections read;
  for (auto& section : toml_sections(text.text, text.file, dialect())) {
    if (section.name == "robot") {
      RobotOptions::table().apply(section, read.options, problems);
      read.robot = std::move(section);
    } else if (section.name == "joint") {
      read.joint_options.push_back(read_joint_options(section, problems));
      read.joints.push_back(std::move(section));
    } else {
      problems.push_back({.what = fmt::format("a robot has no section [{}]", section.name),
                          .place = section.place,
                          .help = "it has one [robot] and a [[joint]] for each joint"});
    }
  }
  for (auto const& [key, size] :
       {std::pair{"gravity", read.options.gravity.size()}, std::pair{"flange_m", read.options.flange_m.size()}})
    if (size != 3)
      problems.push_back(problem_at(read.robot, key, fmt::format("{} holds {} numbers, not 3", key, size),
                                    fmt::format("write {} = [x, y, z] along the base frame's axes", key)));
  return read;
}

void finish(std::vector<Problem>& problems) {
  if (!problems.empty()) throw Error(std::move(problems));
}

double right_or_as_written(double angle, char const* key, std::string const& joint, std::vector<std::string>& remarks) {
  double const nearest = nearest_right_angle(angle);
  if (std::abs(nearest - angle) > rounding_of_an_angle)
    remarks.push_back(
        fmt::format("{} = {} of joint \"{}\" is taken as a right angle, {:.10g}", key, angle, joint, nearest));
  return nearest;
}

// all links have inertias, or none has
void read_links(RobotSections const& read, SerialChain& chain, std::vector<Problem>& problems) {
  auto const with = [](JointOptions const& joint) { return joint.mass_kg > 0.0; };
  if (std::none_of(read.joint_options.begin(), read.joint_options.end(), with)) return;
  for (std::size_t i = 0; i < read.joints.size(); ++i) {
    if (auto const link = link_of(read.joint_options[i])) {
      chain.links.push_back(*link);
    } else if (!with(read.joint_options[i])) {
      problems.push_back(problem_at(read.joints[i], "mass_kg",
                                    fmt::format("joint \"{}\" has no mass, others have", chain.joints[i].name),
                                    "write mass_kg, centre_m and inertia_kgm2 for every joint, or for none"));
    }
  }
}

SerialChain chain_of_numbers(RobotSections const& read, std::vector<Problem>& problems) {
  SerialChain chain;
  for (std::size_t i = 0; i < read.joints.size(); ++i) {
    auto const& options = read.joint_options[i];
    ChainJoint joint;
    joint.name = options.name.empty() ? fmt::format("joint_{}", i + 1) : options.name;
    joint.kind = options.type == "prismatic" ? JointKind::prismatic : JointKind::revolute;
    joint.a = options.a_m;
    joint.d = options.d_m;
    joint.alpha = right_or_as_written(options.alpha_rad, "alpha_rad", joint.name, chain.remarks);
    joint.offset = right_or_as_written(options.offset_rad, "offset_rad", joint.name, chain.remarks);
    apply_drive(read.joints[i], options, joint);
    for (auto const& other : chain.joints)
      if (other.name == joint.name)
        problems.push_back(problem_at(read.joints[i], "name", fmt::format("two joints are called \"{}\"", joint.name),
                                      "give every joint a name of its own"));
    chain.joints.push_back(std::move(joint));
  }
  if (chain.joints.empty())
    problems.push_back(problem_at(read.robot, "convention", "the robot has no joint",
                                  "write a [[joint]] for each, from the base to the tip"));
  read_links(read, chain, problems);
  return chain;
}

// keys that a file with links answers itself
constexpr char const* frame_keys[] = {"type",       "a_m",     "alpha_rad", "d_m",
                                      "offset_rad", "mass_kg", "centre_m",  "inertia_kgm2"};

void add_drives(RobotSections const& read, SerialChain& chain, std::vector<Problem>& problems) {
  std::vector<std::string> names;
  for (auto const& joint : chain.joints) names.push_back(joint.name);
  for (std::size_t i = 0; i < read.joints.size(); ++i) {
    auto const& section = read.joints[i];
    auto const& options = read.joint_options[i];
    for (auto const* key : frame_keys)
      if (section.find(key))
        problems.push_back(
            problem_at(section, key, fmt::format("{} stands in the other file already", key), "leave it out"));
    auto const found = std::find(names.begin(), names.end(), options.name);
    if (found != names.end()) {
      apply_drive(section, options, chain.joints[static_cast<std::size_t>(found - names.begin())]);
      continue;
    }
    auto problem =
        problem_at(section, "name", fmt::format("the arm of {} has no joint \"{}\"", read.options.urdf, options.name),
                   fmt::format("its joints: {}", fmt::join(names, ", ")));
    if (auto const close = closest_name(options.name, names); !close.empty())
      problem.caret_note = fmt::format("did you mean \"{}\"?", close);
    problems.push_back(std::move(problem));
  }
}

// Denavit-Hartenberg numbers name no links
void refuse_part(RobotSections const& read, RobotPart const& asked, std::vector<Problem>& problems) {
  for (char const* const key : {"root", "tip"})
    if (read.robot.find(key))
      problems.push_back(problem_at(read.robot, key, fmt::format("{} is a link of a urdf, and there is none", key),
                                    fmt::format("write urdf = \"robot.urdf\" as well, or leave {} out", key)));
  if (asked.is_whole()) return;
  auto problem = problem_at(read.robot, "urdf",
                            fmt::format("\"{}\" was asked for, and a robot of Denavit-Hartenberg numbers has no links",
                                        asked.tip.empty() ? asked.root : asked.tip),
                            "leave root and tip out: such a file describes one arm");
  problems.push_back(std::move(problem));
}

bool accepts(RobotText const& text) {
  auto const has = [&](char const* words) { return text.text.find(words) != std::string::npos; };
  return has("[robot]") || has("[[joint]]");
}

SerialChain chain_of(RobotText const& text, RobotSections const& sections, RobotPart const& asked,
                     std::string const& convention, std::vector<Problem>& problems) {
  auto const& options = sections.options;
  SerialChain chain;
  if (options.urdf.empty()) {
    refuse_part(sections, asked, problems);
    chain = chain_of_numbers(sections, problems);
    finish(problems);
    Eigen::Vector3d const flange = Eigen::Vector3d::Map(options.flange_m.data());
    chain.flange.position = flange;
    if (convention == "standard_dh") chain = from_standard_dh(std::move(chain));
  } else {
    for (auto const* key : {"convention", "flange_m"})
      if (sections.robot.find(key))
        problems.push_back(
            problem_at(sections.robot, key, fmt::format("{} stands in the other file already", key), "leave it out"));
    finish(problems);
    auto const folder = std::filesystem::path(text.file).parent_path();
    RobotPart const part{asked.root.empty() ? options.root : asked.root, asked.tip.empty() ? options.tip : asked.tip};
    chain = read_linked_robot(folder / options.urdf, part);
    add_drives(sections, chain, problems);
    finish(problems);
  }
  if (!options.name.empty()) chain.name = options.name;
  if (chain.name.empty()) chain.name = std::filesystem::path(text.file).stem().string();
  if (options.urdf.empty() || sections.robot.find("gravity"))
    chain.gravity = chain.base.rotation.transpose() * Eigen::Vector3d::Map(options.gravity.data());
  return chain;
}

SerialChain read(RobotText const& text, RobotPart const& asked) {
  std::vector<Problem> problems;
  auto const sections = read_sections(text, problems);
  return chain_of(text, sections, asked, sections.options.convention, problems);
}

std::optional<OtherConvention> read_otherwise(RobotText const& text) {
  std::vector<Problem> problems;
  auto const sections = read_sections(text, problems);
  if (!sections.options.urdf.empty()) return {};
  std::string const other = sections.options.convention == "standard_dh" ? "modified_dh" : "standard_dh";
  return OtherConvention{other, chain_of(text, sections, {}, other, problems)};
}

}  // namespace

RobotFormat toml() {
  return {"toml", "TOML with [robot] and [[joint]]: standard or modified Denavit-Hartenberg numbers",
          false,  accepts,
          read,   read_otherwise};
}

}  // namespace torquescope::formats
