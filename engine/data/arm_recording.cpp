#include "engine/data/arm_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
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

// one number for all joints, or one for each
void check_count(char const* key, std::vector<double> const& numbers, std::size_t joints, Section const& section,
                 std::vector<Problem>& problems) {
  if (numbers.size() == 1 || numbers.size() == joints) return;
  problems.push_back(
      problem_at(section, key, fmt::format("{} has {} numbers, and the arm has {} joints", key, numbers.size(), joints),
                 "write one number for all joints, or one for each, from the base to the tip"));
}

// the joint whose column each joint has, from 0; its own where nothing is written
std::vector<std::size_t> order_of(char const* key, std::vector<double> const& written, std::size_t joints,
                                  Section const& section, std::vector<Problem>& problems) {
  std::vector<std::size_t> order(joints);
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (written.empty()) return order;
  std::vector<double> sorted = written;
  std::sort(sorted.begin(), sorted.end());
  bool is_order = sorted.size() == joints;
  for (std::size_t j = 0; is_order && j < joints; ++j) is_order = sorted[j] == static_cast<double>(j + 1);
  if (!is_order) {
    problems.push_back(problem_at(section, key, fmt::format("{} is no order of {} joints", key, joints),
                                  fmt::format("write each number from 1 to {} once", joints)));
    return order;
  }
  for (std::size_t j = 0; j < joints; ++j) order[j] = static_cast<std::size_t>(written[j]) - 1;
  return order;
}

double of_joint(std::vector<double> const& numbers, std::size_t joint) {
  return numbers[numbers.size() == 1 ? 0 : joint];
}

}  // namespace

std::vector<RecordingOptions> joint_options(RecordingOptions const& arm, std::vector<std::string> const& joint_names,
                                            Section const& section) {
  std::size_t const joints = joint_names.size();
  std::vector<Problem> problems;
  check_marks(arm, joints, section, problems);
  check_count("torque_per_unit", arm.torque_per_unit, joints, section, problems);
  check_count("delay_s", arm.delay_s, joints, section, problems);
  check_count("joint_sign", arm.joint_sign, joints, section, problems);
  check_count("zero", arm.zero, joints, section, problems);
  if (std::any_of(arm.joint_sign.begin(), arm.joint_sign.end(), [](double sign) { return std::abs(sign) != 1.0; }))
    problems.push_back(problem_at(section, "joint_sign", "joint_sign holds another number than 1 and -1",
                                  "write 1 or -1 for each joint"));
  auto const positions = order_of("position_order", arm.position_order, joints, section, problems);
  auto const torques = order_of("torque_order", arm.torque_order, joints, section, problems);
  if (!problems.empty()) throw Error(std::move(problems));

  std::vector<RecordingOptions> options;
  for (std::size_t j = 0; j < joints; ++j) {
    Marks const of_position = marks_of(positions[j], joint_names[positions[j]]);
    Marks const of_torque = marks_of(torques[j], joint_names[torques[j]]);
    RecordingOptions one = arm;
    for (auto& [channel, column] : one.columns) column = filled(column, channel == "torque" ? of_torque : of_position);
    for (auto& [channel, column] : one.clocks) column = filled(column, channel == "torque" ? of_torque : of_position);
    one.simulated_torque = filled(one.simulated_torque, of_torque);
    double const sign = of_joint(arm.joint_sign, j);
    one.position_per_unit *= sign;
    one.velocity_per_unit *= sign;
    one.torque_per_unit = {sign * of_joint(arm.torque_per_unit, j)};
    one.delay_s = {of_joint(arm.delay_s, j)};
    one.zero = {of_joint(arm.zero, j)};
    one.joint_sign = {1.0};
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
