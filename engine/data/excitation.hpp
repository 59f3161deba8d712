#pragma once
// How a recording excites a joint: the table `check` prints and the page shows, and warnings about what it cannot tell.
//
// Units      as Recording and Motion; moving means faster than 1 % of the largest speed
// Source     Swevers et al. 1997, "Optimal robot excitation and identification": a fit sees only what the motion visits
// Threads    functions of their arguments

#include <Eigen/Core>
#include <array>
#include <vector>

#include "engine/data/motion.hpp"

namespace torquescope {

struct Excitation {
  double duration_s = 0.0;
  double position_least = 0.0, position_most = 0.0;
  double speed_least = 0.0, speed_most = 0.0;  // signed
  double acceleration_rms = 0.0;
  double torque_least = 0.0, torque_most = 0.0;
  double moving_share = 0.0;               // of time
  double forward_share = 0.0;              // of moving time with dq > 0
  Eigen::Index reversals = 0;              // changes of direction, each side moving
  std::array<double, 4> quadrant_share{};  // of moving time: (dq,torque) = (+,+) (-,+) (-,-) (+,-)
  int quadrants = 0;                       // of them, visited at least 1 % of moving time
  double speed_spread = 0.0;               // 95th over 10th percentile of |dq| while moving
  double one_speed_share = 0.0;       // of moving time, the most within a factor of 1.2; by measure_excitation() alone
  double encoder_step = 0.0;          // RowFacts, or found in the recording's position
  double torque_limit_share = 0.0;    // RowFacts, or found in the recording's torque
  Eigen::Index torque_held_rows = 1;  // signal_facts.hpp
  double torque_updates = 0.0;  // of a torque that is held: per period of the parallel cut-off; by measure_motion()
  double torque_noise = 0.0;    // standard deviation, white part (signal_facts.hpp)
  double jitter = 0.0;          // RowFacts
};

// speeds, directions and quadrants come from between the edges that the filter drops
Excitation measure_excitation(Recording const& recording, Motion const& motion, FilterOptions const& options);

// the same in two halves, for a caller who gives the channels away for the motion: what they show by themselves, then
// the motion
Excitation measure_channels(Recording const& recording);
void measure_motion(Motion const& motion, FilterOptions const& options, Excitation& facts);

// what cannot be identified from such a motion, topic "excitation". `unit` of the position: "rad" or "m"
std::vector<DataWarning> excitation_warnings(Excitation const& excitation, char const* unit);

}  // namespace torquescope
