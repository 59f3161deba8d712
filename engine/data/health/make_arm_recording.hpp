#pragma once
// From the rows of a file to the recording of an arm: each joint examined as make_recording() does, all on one clock.
//
// Findings   say whose joint they are about, in Finding::joint; what is true of all joints alike (the clock, the
//            reader's remarks) is said once. That other joints move is no finding here
// Errors     those of joint_options() and make_recording(), of all joints at once; 65: no one clock
// Threads    free function

#include "engine/data/arm_recording.hpp"

namespace torquescope {

ArmRecording make_arm_recording(RawTable const& table, std::vector<RecordingOptions> const& joints,
                                std::vector<std::string> const& joint_names, Section const& section);

}  // namespace torquescope
