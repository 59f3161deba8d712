#pragma once
// The loop a recording was made in: controller, torque limit, noise, encoder, and the motion to follow.
//
// Sources    identified: one linear law with a white remainder. approximated: a law whose remainder is coloured;
//            replicates carry its spectrum. tracking: no reference; a stiff loop of our own (bandwidth 3 % of the rate
//            or less) follows the smoothed motion, with the needed torque fed forward; thrice that torque is no
//            runaway. Not calibrated for elasticity, payload and delay
// Limit      of the torque: the drive's, or the measurement channel's when the joint got most of what was asked beyond
//            it
// Noise      tracking: white noise from second differences, an upper bound; measured with replicates: torque_colour.hpp
// Units      SI. Requires 100 samples
// Threads    free functions
// Source     METHOD.md, The controller

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/data/motion.hpp"
#include "engine/data/recording.hpp"
#include "engine/simulate/clean_twin.hpp"
#include "engine/simulate/controller_fit.hpp"
#include "engine/simulate/tracking_law.hpp"

namespace torquescope {

enum class LoopSource { identified, approximated, tracking };

struct RecordedLoop {
  LoopSource source = LoopSource::identified;
  TwinLoop loop{};
  TwinTrack track{};
  std::optional<ControllerFit> controller{};  // not for tracking
  std::string remark{};
};

// by the model, one per sample; needed where some samples are limited
using NeededTorque = std::function<Eigen::VectorXd(std::vector<LimitedSample> const&)>;

// joint: the baseline, for the tracking loop; cutoff of `filter` smooths the motion it follows; needed_torque: none
// where no model is at hand
RecordedLoop recorded_loop(Recording const& recording, TrackedJoint const& joint, FilterOptions const& filter,
                           NeededTorque const& needed_torque = {});

// as if the recording had no reference: what to fall back to when the identified loop runs away
RecordedLoop tracking_loop(Recording const& recording, TrackedJoint const& joint, FilterOptions const& filter);

// The joint is driven by the recorded torque, low-passed by `filter`, and led slowly by errors of the smoothed motion:
// so its friction turns round by itself, as it did in the recording, and not where a smooth motion says. The law sees
// the position before the encoder's steps; there is no controller, and `source` is tracking
RecordedLoop torque_fed_loop(Recording const& recording, double inertia, FilterOptions const& filter);

}  // namespace torquescope
