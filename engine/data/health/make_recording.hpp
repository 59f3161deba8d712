#pragma once
// From the rows of a file to an evenly sampled recording in SI units, examined on the way (the other files of this
// folder).
//
// Corrected  what leaves no doubt; Recording::findings says each, with its rows
// Left out   stretches without values, and those of recording.leave_out: filled, and not looked at
//            (Recording::left_out)
// Faults     are findings as well: who calls decides whether they end the work (health/finding_text.hpp)
// Position   the integral of the velocity where columns names none (integrated_position.hpp)
// Torque     zeros where TorqueColumn::optional and the mapping names none
// Errors     Error 78 of the mapping; 65: too few rows, a signal that never changes, a clock that cannot be mended
// Threads    free function

#include "engine/data/recording_reader.hpp"
#include "engine/data/torque_column.hpp"

namespace torquescope {

// positions of joints beside the one that was asked for (Recording::other_positions)
enum class OtherJoints { ignored, kept };

// `section` is the job's [recording]: its places stand in the messages
Recording make_recording(RawTable const& table, RecordingOptions const& options, Section const& section,
                         OtherJoints others = OtherJoints::ignored, TorqueColumn torque = TorqueColumn::required);

}  // namespace torquescope
