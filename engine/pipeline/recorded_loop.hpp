#pragma once
// The loop a recording was made in, as far as the recording tells: the controller, its noise, its encoder, its track.
//
// Sources    identified       reference, position and torque obey one linear law with a white remainder
//            approximated     they obey it with a remainder that is not white: twins carry the remainder's spectrum
//            tracking         no reference: a stiff loop of our own (bandwidth 3 % of the rate, less where a step of
//            the
//                             encoder would ask for more than the recording's torque) follows the smoothed
//                             measured motion, what the joint needs for it fed forward; good for most names, not
//                             calibrated for elasticity, payload and delay
// Limit      of the torque: the drive's, unless the joint has got most of what was asked for beyond it. Then it is one
//            of the channel that tells the torque, the loop has none (its controller keeps it), and what is missing in
//            the record is for the search to find. The upper and the lower one by themselves
// Noise      tracking: white torque noise from second differences, an upper bound while the torque itself bends; what
//            it is in the band of the fit, and how slow, is measured with twins (torque_colour.hpp)
// Ends       the motion that twins follow goes on as its odd reflection while it is smoothed: no accelerations of the
//            filter's
// Units      SI
// Requires   100 samples
// Threads    free functions
// Source     LESSONS items 1 and 2 of our own prototype

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

// by the model, one per sample; asked for where some samples are limited
using NeededTorque = std::function<Eigen::VectorXd(std::vector<LimitedSample> const&)>;

// joint: the baseline, for the tracking loop; cutoff of `filter` smooths the motion it follows; needed_torque: none
// where no model is at hand
RecordedLoop recorded_loop(Recording const& recording, TrackedJoint const& joint, FilterOptions const& filter,
                           NeededTorque const& needed_torque = {});

// as if the recording had no reference: what to fall back to when the identified loop runs away
RecordedLoop tracking_loop(Recording const& recording, TrackedJoint const& joint, FilterOptions const& filter);

}  // namespace torquescope
