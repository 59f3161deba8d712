#pragma once
// One recording as a simulation follows it: what goes in, what is measured, and where it begins anew.
//
// Segments   runs of samples without a gap; each is simulated from a state of its own: measured position, slope of the
//            measured positions, torque as recorded. Without a reference the recorded torque drives the joint in
//            windows, because an open loop forgets nothing
// Ticks      the loop answers ticks_per_sample times a sample; between two samples a reference is held, or straight
// Shapes     every channel [n]; absent ones are empty
// Units      SI of the joint's kind; added in its column's own unit
// Threads    plain record, free functions

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "engine/data/recording.hpp"
#include "engine/simulate/loop_controller.hpp"
#include "engine/simulate/rollout/track_known.hpp"

namespace torquescope {

struct TrackSegment {
  Eigen::Index first = 0, samples = 0;
  double position = 0.0, velocity = 0.0, torque = 0.0;  // where it begins; torque NaN: not recorded
  Eigen::Index settling = 0;  // samples before `first` where it begins: simulated, not compared
};

enum class TrackDrive { reference, torque };

struct RolloutTrack {
  std::string name;
  TrackDrive drive = TrackDrive::reference;
  double rate_hz = 0.0;
  std::size_t ticks_per_sample = 1;
  bool straight_reference = false;  // between samples; else held
  double encoder_step = 0.0;        // 0: unknown or too fine to see
  Eigen::VectorXd time_s, reference, position, torque;
  Eigen::VectorXd added, outside, enabled;
  std::vector<TrackSegment> segments;
  TrackKnown known{};
  std::optional<LoopController> controller{};  // found in this recording; none: the loop's numbers are the whole of it

  double tick_s() const { return 1.0 / (rate_hz * static_cast<double>(ticks_per_sample)); }
  Eigen::Index samples() const;  // of all segments
};

struct TrackOptions {
  double controller_rate_hz = 0.0;  // 0: the recording's
  bool straight_reference = false;
  double window_s = 0.05;  // of a track without a reference
  bool has_torque = true;  // else the recording's torque is no measurement, and its command begins at the loop's own
};

// What a simulation of the positions has to tell, [n]: measured less what is known anyhow. That is their mean; in
// windows, which begin at the measured state, the straight way on from there
Eigen::VectorXd untold_positions(RolloutTrack const& track);

// Errors     Error 65 where no run of samples is long enough to be simulated
RolloutTrack track_of(Recording const& recording, TrackOptions const& options);

// A track of more than `most` samples as four stretches of together as many, spread evenly over its time; another one
// as it is. A stretch settles for a quarter of its length: what its loop and friction remember is not recorded
RolloutTrack in_stretches(RolloutTrack track, Eigen::Index most);

}  // namespace torquescope
