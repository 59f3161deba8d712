#pragma once
// Where within a sample the torque channel was read: not known, not asked, and no fault.
//
// Why        twins hold the torque of a row from its sample to the next, as a controller does that runs at the rate of the
//            recording. A drive whose loop is faster than its log, or one that logs the current of the instant, writes a torque
//            that comes half a sample later to its motion. Nobody can tell that from a channel that is late by as much
// Rule       a delay that the search names, and that is no more than half a sample (and a tenth of one, for what a current loop
//            needs itself; one sample where there is no reference, so that no law tells which torque a row holds), is taken out of
//            the recordings, and the search begins again. A longer one is a finding
// Threads    free functions
// Units      s

#include <optional>

#include "engine/data/recording.hpp"
#include "engine/diagnose/forward_selection.hpp"

namespace torquescope {

// how late the named delay is when it is within that; nothing when none is named, or a longer one
std::optional<double> delay_within_a_sample(Selection const& selection, double rate_hz);

// the torque as if it had been read late_s earlier, by straight lines between samples; |late_s| below a sample period
Recording with_torque_earlier(Recording recording, double late_s);

// for people: what was done to the recordings
std::string timing_remark(double late_s, double rate_hz);

}  // namespace torquescope
