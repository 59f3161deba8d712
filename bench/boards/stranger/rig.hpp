#pragma once
// A rig: one axis with its rigid-body dynamics, dry and viscous friction. This is all that a job's model knows.
//
// Equation   J a = u - Fv v - F(sign v) - offset - g sin(q - q_hang)
// Units      SI; revolute N m and rad, prismatic N and m
#include <string>
#include <vector>

namespace stranger {

struct Rig {
  std::string name;
  bool slides = false;
  double inertia = 1;       // [kg m^2 or kg]
  double viscous = 0;       // [N m s/rad or N s/m]
  double dry_forward = 0;   // [N m or N]
  double dry_backward = 0;  // positive
  double offset = 0;
  double weight = 0;        // [N m] torque of the weight with the link level
  double hang = 0;          // [rad] angle at which the link hangs
  double load_share = 0.7;  // part of the inertia behind the transmission
  double torque_limit = 1e9;
  double torque_rms = 1;  // what it typically needs: the measure of noise
  double centre = 0;      // [rad or m] middle of the travel
  double half_travel = 1;
  double top_speed = 1;
  std::vector<std::string> terms;  // of the job's model
};

Rig find_rig(std::string const& name);

}  // namespace stranger
