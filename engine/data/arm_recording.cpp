#include "engine/data/arm_recording.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace torquescope {
namespace {

using Marks = std::array<std::pair<std::string, std::string>, 3>;

Marks marks_of(std::size_t joint, std::string const& name) {
  return {{{"{j}", std::to_string(joint + 1)}, {"{i}", std::to_string(joint)}, {"{name}", name}}};
}

std::string filled(std::string text, Marks const& marks) {
  for (auto const& [mark, value] : marks)
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
      text.replace(at, mark.size(), value);
  return text;
}

// what a joint's mapping would be if it were alone; problems are those of the first joint
void check_marks(RecordingOptions const& arm, std::size_t joints, Section const& section,
                 std::vector<Problem>& problems) {
  Marks const marks = marks_of(0, "a joint's name");
  auto const check = [&](char const* key, std::string const& channel, std::string const& column) {
    if (channel == "time" || filled(column, marks) != column) return;
    problems.push_back(problem_at(
        section, key, fmt::format("{} = \"{}\" is one column, and the arm has {} joints", channel, column, joints),
        fmt::format("write {{j}} where the joint's number stands: {} = \"q{{j}}\"", channel)));
  };
  if (joints < 2) return;
  for (auto const& [channel, column] : arm.columns) check("columns", channel, column);
  if (!arm.simulated_torque.empty()) check("simulated_torque", "simulated_torque", arm.simulated_torque);
}

}  // namespace

std::vector<RecordingOptions> joint_options(RecordingOptions const& arm, std::vector<std::string> const& joint_names,
                                            Section const& section) {
  std::size_t const joints = joint_names.size();
  std::vector<Problem> problems;
  check_marks(arm, joints, section, problems);
  auto const& factors = arm.torque_per_unit;
  if (factors.size() != 1 && factors.size() != joints)
    problems.push_back(
        problem_at(section, "torque_per_unit",
                   fmt::format("torque_per_unit has {} numbers, and the arm has {} joints", factors.size(), joints),
                   "write one number for all joints, or one for each, from the base to the tip"));
  if (!problems.empty()) throw Error(std::move(problems));

  std::vector<RecordingOptions> options;
  for (std::size_t j = 0; j < joints; ++j) {
    Marks const marks = marks_of(j, joint_names[j]);
    RecordingOptions one = arm;
    for (auto& [channel, column] : one.columns) column = filled(column, marks);
    one.simulated_torque = filled(one.simulated_torque, marks);
    one.torque_per_unit = {factors[factors.size() == 1 ? 0 : j]};
    options.push_back(std::move(one));
  }
  return options;
}

std::string joint_title(std::size_t joint, std::vector<std::string> const& joint_names) {
  std::string const number = std::to_string(joint + 1), &name = joint_names[joint];
  bool const says_it = name.empty() || (name.size() > number.size() && name.ends_with(number));
  if (name.empty()) return "joint " + number;
  return says_it ? name : fmt::format("joint {} ({})", number, name);
}

}  // namespace torquescope
