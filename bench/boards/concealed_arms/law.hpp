#pragma once
// What is concealed in a joint, or in the whole arm: torque beyond rigid arm, viscous, Coulomb and constant torque.
//
// dry()      added to the Coulomb level of its joint [N m]: resists like it, set-valued at rest
// smooth()   added to what the joint needs [N m], a function of the state alone
// Neither    a tilted base, a zero that is off, an elastic joint: the plant itself differs (arm_loop.hpp)
// Size       multiplies everything; the plant sets it so that a drawn SNR is reached (arm_case.hpp)
// Words      names and families of the engine's catalogue, which nothing here is computed from

#include <string>
#include <vector>

#include "concealed/noise.hpp"
#include "concealed_arms/arm_numbers.hpp"

namespace concealed_arms {

enum class LawKind {
  load_friction,
  stribeck,
  power_viscous,
  asymmetric_viscous,
  spring,
  position_friction,
  cogging,
  friction_of_previous,
  friction_of_next,
  tilted_base,
  joint_zero,
  elastic_joint
};

struct LawWords {
  LawKind kind;
  char const* name;                   // of the catalogue
  std::vector<std::string> families;  // it may answer to, own one first
};

struct Instant {
  double q = 0.0, v = 0.0, load = 0.0, neighbour_speed = 0.0;
};

struct Law {
  LawKind kind = LawKind::spring;
  int joint = 0;                         // from 0; a tilted base has 0 as well
  double size = 0.0;                     // N m, N m/rad, rad, ...: what stands before the shape
  double smallest = 0.0, largest = 0.0;  // what a joint can have
  double shape = 0.0, second = 0.0;
  // its SNR is that of the joint where most is left
  bool is_of_several_joints() const;
  double dry(Instant const& now) const;
  double smooth(Instant const& now) const;
  int neighbour(int joints) const;  // whose speed it needs, or -1
};

std::vector<LawWords> const& law_words();
LawWords const& words_of(LawKind kind);
LawWords const& words_of(std::string const& name);  // std::invalid_argument when there is none

// range of a joint's motion [rad], its highest speed [rad/s], the mean inertia of the links about it [kg m2]
struct JointMoves {
  double travel = 0.0, fastest = 0.0, inertia = 0.0;
};

// shape and bounds of a law at a joint. std::invalid_argument where the joint cannot have it
Law drawn_law(LawKind kind, Arm const& arm, int joint, JointMoves const& moves, concealed::Random& random);
// joints that can have it
std::vector<int> possible_joints(LawKind kind, Arm const& arm);

}  // namespace concealed_arms
