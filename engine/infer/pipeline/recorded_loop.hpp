#pragma once
// A loop in which a simulated joint does what a recording shows: what replicates of its model are led by.
//
// Fed        by the recorded torque, low-passed, and led slowly to the smoothed motion
// Tracking   a stiff loop of our own (bandwidth 3 % of the rate or less) follows the smoothed motion; thrice the torque
//            of the recording, or of the model along its motion, is no runaway
// Noise      tracking: white noise from second differences, an upper bound
// Units      SI. Requires 100 samples
// Threads    free functions

#include "engine/data/motion.hpp"
#include "engine/data/recording.hpp"
#include "engine/simulate/replicate_simulator.hpp"
#include "engine/simulate/tracking_controller.hpp"

namespace torquescope {

struct RecordedLoop {
  ReplicateLoop loop{};
  ReplicateTrack track{};
};

// joint: of the model, whose torque leads
RecordedLoop tracking_loop(Recording const& recording, TrackedJoint const& joint, FilterOptions const& filter);

// The joint is driven by the recorded torque, low-passed by `filter`, and led slowly by errors of the smoothed motion:
// so its friction turns round by itself, as it did in the recording, and not where a smooth motion says. The controller
// sees the position before the encoder's steps
RecordedLoop torque_fed_loop(Recording const& recording, double inertia, FilterOptions const& filter);

}  // namespace torquescope
