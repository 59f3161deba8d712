#include "engine/app/result/robot_json.hpp"

#include <nlohmann/json.hpp>

namespace torquescope {

namespace {

using Json = nlohmann::ordered_json;

// NaN is written as null
Json joint_json(RobotDescription::Joint const& joint) {
  return {{"name", joint.name},
          {"kind", joint.kind},
          {"alpha", joint.alpha},
          {"a", joint.a},
          {"offset", joint.offset},
          {"d", joint.d},
          {"lower", joint.lower},
          {"upper", joint.upper},
          {"max_speed", joint.max_speed},
          {"max_acceleration", joint.max_acceleration},
          {"max_torque", joint.max_torque},
          {"gear_ratio", joint.gear_ratio},
          {"drive_inertia", joint.drive_inertia}};
}

}  // namespace

std::string robot_json(RobotDescription const& robot) {
  Json joints = Json::array(), parameters = Json::array();
  for (auto const& joint : robot.joints) joints.push_back(joint_json(joint));
  for (auto const& parameter : robot.parameters)
    parameters.push_back({{"name", parameter.name}, {"sum", parameter.sum}, {"unit", parameter.unit}});
  Json const document = {{"schema", 1},
                         {"robot",
                          {{"name", robot.name},
                           {"gravity", robot.gravity},
                           {"base", robot.base},
                           {"flange", robot.flange},
                           {"mass", robot.has_inertias ? Json(robot.mass) : Json(nullptr)},
                           {"joints", joints},
                           {"standard_parameters", robot.standard_parameters},
                           {"rigid_base_parameters", robot.rigid_parameters},
                           {"base_parameters", parameters},
                           {"without_effect", robot.without_effect},
                           {"warnings", robot.warnings},
                           {"remarks", robot.remarks}}}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace torquescope
