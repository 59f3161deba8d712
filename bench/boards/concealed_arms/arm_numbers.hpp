#pragma once
// What an arm of the plant is made of: kinematics, masses, drives, friction, noise; drawn anew for every case.
//
// Frames     Denavit-Hartenberg: standard theta d a alpha, modified alpha a theta d; theta = q + offset
// Units      SI; inertia about the centre of mass, xx xy xz yy yz zz in the link's frame
// Sources    CRS A465 and Panda: public kinematics as in jobs/robots; every mass and inertia is made up

#include <array>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace concealed_arms {

inline constexpr double full_turn = 2.0 * std::numbers::pi;

struct Link {
  char const* name = "";
  double a = 0.0, alpha = 0.0, d = 0.0, offset = 0.0;
  double lower = 0.0, upper = 0.0;  // of the motion [rad]
  double max_speed = 0.0, max_acceleration = 0.0;
  double counts = 0.0;  // of the encoder, per turn of the joint
  double drive_inertia = 0.0;
  double mass = 0.0;
  std::array<double, 3> centre{};
  std::array<double, 6> inertia{};
  double viscous = 0.0, coulomb = 0.0, offset_torque = 0.0;
  double noise = 0.0;  // of the torque's log, standard deviation [N m]
};

struct Arm {
  std::string name;
  bool standard_dh = false;
  std::vector<Link> links;
  int joints() const { return static_cast<int>(links.size()); }
};

// "crs" (five joints) or "seven" (the kinematics of a Panda); anything else is std::invalid_argument
Arm nominal_arm(std::string const& name);
// masses, frictions, drives and noise of one specimen
Arm drawn_arm(std::string const& name, std::uint64_t seed);

}  // namespace concealed_arms
