#pragma once
// What `torquescope describe` says of a robot file: frames, limits, base parameters and what each gathers.
//
// Units      SI; NaN where the file says nothing
// Errors     those of read_robot()

#include <filesystem>
#include <string>
#include <vector>

#include "engine/robot/robot_part.hpp"

namespace torquescope {

struct RobotDescription {
  struct Joint {
    std::string name, kind;      // "revolute"
    double alpha, a, offset, d;  // modified DH
    double lower, upper, max_speed, max_acceleration, max_torque, gear_ratio, drive_inertia;
  };
  struct Parameter {
    std::string name, sum, unit;  // "xxr2", "xx2 - yy2", "kg m^2"
  };

  std::string name;
  std::vector<double> gravity;       // m/s^2 in frame 0
  std::vector<double> base, flange;  // origins, m: frame 0 in the file's base; the tool in the last frame
  std::vector<Joint> joints;
  bool has_inertias = false;
  double mass = 0.0;                                  // kg, of all links; 0 without inertias
  std::vector<Parameter> parameters;                  // with drive inertias
  int standard_parameters = 0, rigid_parameters = 0;  // of the links; base parameters without drives
  std::vector<std::string> without_effect;            // standard parameters that no torque depends on
  std::vector<std::string> remarks, warnings;         // sentences; warnings with file and line
};

RobotDescription describe_robot(std::filesystem::path const& file, RobotPart const& part = {});

}  // namespace torquescope
