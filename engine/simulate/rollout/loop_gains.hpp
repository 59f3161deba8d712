#pragma once
// First values of a controller's gains from a recording: least squares of the torque on what the controller sees.
//
// Equation   u = kp e + kd s + ki (integral of e) + ki_speed (integral of s) + constant, e and s as loop_numbers.hpp
//            has them, of the measured positions; the gains of the form follow (loop_form.hpp)
// Rows       samples whose torque is not at the limit; shifted by command_delay_s and torque_delay_s to the sample
// Error      of the whole loop: what it leaves of the recorded torque on all samples, as a share of its rms
// Threads    free functions

#include "engine/simulate/loop_controller.hpp"
#include "engine/simulate/rollout/loop_form.hpp"
#include "engine/simulate/rollout/track.hpp"

namespace torquescope {

// wanted: keys of gains_of(form) that are not given, with values from the recordings; positive, or the smallest that is
// plausible
LoopValues with_first_gains(LoopForm form, LoopValues values, std::vector<LoopKey> const& wanted,
                            std::size_t speed_samples, std::vector<RolloutTrack> const& tracks);

// Samples that the difference spans which a controller takes for the speed: the fewest with which it answers as the
// recorded torque does. What rounding of the positions makes of the difference is taken off; three standard errors of
// the mean square decide
std::size_t speed_span(LoopForm form, LoopValues const& values, std::vector<LoopKey> const& wanted,
                       std::vector<RolloutTrack> const& tracks);

// the loop's own answer to the measured positions beside the recorded torque; NaN of one with an integral
double loop_error(LoopNumbers const& numbers, std::size_t speed_samples, RolloutTrack const& track);
double loop_error(LoopController const& by, RolloutTrack const& track);

}  // namespace torquescope
