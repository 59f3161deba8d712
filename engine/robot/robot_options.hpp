#pragma once
// What a robot file in TOML says: [robot] once, [[joint]] for each joint from the base to the tip.
//
// Units      SI; a slide reads m for rad, kg for kg m^2 and N for N m. DH numbers as the convention has them
// Threads    plain records; tables are immutable

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/robot/serial_chain.hpp"

namespace torquescope {

struct RobotOptions {
  std::string name{};
  std::string convention = "modified_dh";
  std::vector<double> gravity{0.0, 0.0, -9.81};  // m/s^2 in the base frame
  std::vector<double> flange_m{0.0, 0.0, 0.0};
  std::string urdf{};  // URDF, xacro or MJCF: frames and inertias from there
  std::string root{};  // its link that stands still
  std::string tip{};   // its link where the arm ends

  static OptionTable<RobotOptions> const& table();
};

struct JointOptions {
  std::string name{};
  std::string type = "revolute";
  double a_m = 0.0, alpha_rad = 0.0, d_m = 0.0, offset_rad = 0.0;
  double lower = -ChainJoint::no_limit, upper = ChainJoint::no_limit;
  double max_speed = ChainJoint::no_limit, max_acceleration = ChainJoint::no_limit;
  double max_torque = ChainJoint::no_limit;
  double gear_ratio = 1.0;
  double drive_inertia = 0.0;
  double encoder_counts = 0.0;
  double mass_kg = 0.0;
  std::vector<double> centre_m{};
  std::vector<double> inertia_kgm2{};

  static OptionTable<JointOptions> const& table();
};

// what was written for one joint, checked as far as one joint can be; problems have places
JointOptions read_joint_options(Section const& section, std::vector<Problem>& problems);
// drive, limits and encoder; nothing that was not written changes
void apply_drive(Section const& section, JointOptions const& options, ChainJoint& joint);
// in the frame of the convention; nothing when no mass is written
std::optional<LinkInertia> link_of(JointOptions const& options);

}  // namespace torquescope
