#pragma once
// What is known of one recording beside its channels: the load that hung there, the gain and the limit of its drive.
//
// Use        a simulation adds it to every trial on that track: many recordings then share one set of parameters
// Units      SI; of the command: the unit of the drive's command (V, A, ...) per rad, and that unit
// Threads    plain record

#include <limits>

namespace torquescope {

struct TrackKnown {
  double gravity_moment = 0.0;  // N m, of sin(position)
  double inertia = 0.0;         // kg m2
  double command_gain = 1.0;    // of the loop's gains
  double command_limit = std::numeric_limits<double>::infinity();
  double arm_length = 0.0;                                        // m, of a bar whose mass is not known
  double temperature = std::numeric_limits<double>::quiet_NaN();  // deg C; NaN: not known
};

}  // namespace torquescope
