#pragma once
// How far an arm stays from a table and from itself, with its links as lines between the origins of their frames.
//
// Table      the plane z = floor_m of the base frame; the origins of links from the second on, and the flange, stay
//            above it
// Itself     lines that do not meet in a joint stay clearance_m apart: twice the radius of a link, say
// Units      m
// Threads    pure functions

#include <Eigen/Core>
#include <limits>

#include "engine/robot/serial_chain.hpp"

namespace torquescope {

struct ClearanceLimits {
  double floor_m = -std::numeric_limits<double>::infinity();
  double clearance_m = 0.0;  // 0: not looked at

  bool are_any() const { return floor_m > -std::numeric_limits<double>::infinity() || clearance_m > 0.0; }
};

// by how much an arm at q is too near; 0 where it is not
double clearance_lack(SerialChain const& chain, ClearanceLimits const& limits,
                      Eigen::Ref<Eigen::VectorXd const> const& q);

struct LineSegment {
  Eigen::Vector3d from, to;
};
// Source     Ericson 2005, Real-Time Collision Detection, section 5.1.9
double distance(LineSegment const& a, LineSegment const& b);

}  // namespace torquescope
