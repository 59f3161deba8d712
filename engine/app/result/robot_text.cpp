#include "engine/app/result/robot_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/app/terminal/plain_text.hpp"
#include "engine/app/terminal/table.hpp"

namespace torquescope {

namespace {

using Align = TextTable::Align;

std::string cell_text(double value) { return std::isnan(value) ? "-" : short_number(value); }

std::string vector_text(std::vector<double> const& v) {
  return fmt::format("[{}, {}, {}]", short_number(v[0]), short_number(v[1]), short_number(v[2]));
}

std::string frames_text(RobotDescription const& robot) {
  TextTable table({Align::right, Align::left, Align::left, Align::right, Align::right, Align::right, Align::right},
                  "  ");
  table.row({"", "joint", "moves", "alpha [rad]", "a [m]", "offset [rad]", "d [m]"});
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    auto const& joint = robot.joints[i];
    table.row({std::to_string(i + 1), printable(joint.name), joint.kind, cell_text(joint.alpha), cell_text(joint.a),
               cell_text(joint.offset), cell_text(joint.d)});
  }
  return table.text(page_width());
}

// columns that the file fills for at least one joint
std::string limits_text(RobotDescription const& robot) {
  using Joint = RobotDescription::Joint;
  struct LimitColumn {
    char const* title;
    double Joint::*member;
  };
  constexpr LimitColumn all[] = {{"lower", &Joint::lower},
                                 {"upper", &Joint::upper},
                                 {"speed", &Joint::max_speed},
                                 {"acceleration", &Joint::max_acceleration},
                                 {"torque", &Joint::max_torque},
                                 {"gear", &Joint::gear_ratio},
                                 {"drive inertia", &Joint::drive_inertia}};
  std::vector<LimitColumn> columns;
  for (auto const& column : all)
    if (std::any_of(robot.joints.begin(), robot.joints.end(),
                    [&](Joint const& j) { return !std::isnan(j.*column.member); }))
      columns.push_back(column);
  if (columns.empty()) return "";
  TextTable table(std::vector<Align>(1 + columns.size(), Align::right), "  ");
  std::vector<std::string> head{""};
  for (auto const& column : columns) head.emplace_back(column.title);
  table.row(head);
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    std::vector<std::string> cells{std::to_string(i + 1)};
    for (auto const& column : columns) cells.push_back(cell_text(robot.joints[i].*column.member));
    table.row(cells);
  }
  return "\n" + hanging("", "limits and drives (rad, m, N m, s, kg; at the joint)") + table.text(page_width());
}

std::string parameters_text(RobotDescription const& robot) {
  auto text =
      "\n" + hanging("", fmt::format("base parameters: {} of the {} numbers of the links; {} with drive inertias. "
                                     "Friction is counted apart",
                                     robot.rigid_parameters, robot.standard_parameters, robot.parameters.size()));
  TextTable table({Align::left, Align::left, Align::left}, "  ");
  for (auto const& parameter : robot.parameters)
    table.row({parameter.name, parameter.unit, parameter.sum == parameter.name ? "" : "= " + parameter.sum});
  text += table.text(page_width());
  if (!robot.without_effect.empty())
    text += hanging("  no torque depends on  ", fmt::format("{}", fmt::join(robot.without_effect, ", ")));
  return text;
}

}  // namespace

std::string robot_text(RobotDescription const& robot, Ink const& ink) {
  auto text = hanging(ink.bold(printable(robot.name)) + "  ",
                      fmt::format("{} joints; masses {}", robot.joints.size(),
                                  robot.has_inertias ? fmt::format("given, {} kg", short_number(robot.mass))
                                                     : "not given, and not needed to identify"));
  text += hanging("  gravity  ", vector_text(robot.gravity) + " m/s^2 in frame 0");
  if (robot.base != std::vector<double>{0.0, 0.0, 0.0})
    text += hanging("  frame 0  ", vector_text(robot.base) + " m in the file's base frame");
  text += hanging("  tool     ", vector_text(robot.flange) + " m in the last frame");
  text += "\n" + hanging("", "frames: modified Denavit-Hartenberg, Rx(alpha) Tx(a) Rz(q + offset) Tz(d)");
  text += frames_text(robot) + limits_text(robot) + parameters_text(robot);
  for (auto const& warning : robot.warnings) text += hanging("  warning  ", printable(warning));
  for (auto const& remark : robot.remarks) text += hanging("  note  ", printable(remark));
  return text;
}

}  // namespace torquescope
