#pragma once
// The [model] section of a job: which terms one joint has, or which arm it is and what its joints have beside it.

#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/effects/regressor.hpp"

namespace torquescope {

struct ModelOptions {
  std::string joint = "revolute";
  std::vector<std::string> terms{};
  double velocity_deadband = 0.0;
  // of an arm
  std::string robot{};                  // its file, relative to the job's; "": the job is about one joint
  std::string root{}, tip{};            // links of that file between which the arm is; "": all of it
  std::vector<std::string> friction{};  // terms of every joint beside the rigid arm
  bool drive_inertia = true;            // rotors are parameters of their own
  std::vector<double> gravity{};        // m/s^2 in the base frame of an arm; empty: as its file says
  bool drive_gains = false;             // errors of torque_per_unit as well

  static OptionTable<ModelOptions> const& table();
};

// [model.joint_1], [model.joint_2], ...
struct JointModelOptions {
  std::vector<std::string> friction{};
  std::vector<double> motor_turns_by{};  // row of the transmission; empty: its own joint alone

  static OptionTable<JointModelOptions> const& table();
};

// Errors     as Regressor()
Regressor make_regressor(ModelOptions const& options, Section const& model);

}  // namespace torquescope
