#pragma once
// Where within a sample the torque channel was read: a delay of up to a sample is a convention of the log, no fault.
//
// Lags       none (held from the row on), half a sample (torque of the instant) or a whole one (mean since the row
//            before, or one sample early) are conventions. Any other lag, certain and beyond a tenth of a sample, is a
//            finding
// Rule       a delay of at most 1.1 samples is taken out of the recordings and the search begins again: when it was
//            accepted, when it explains nine tenths of what was accepted first, or when nothing explains the recording
//            and the controller's law is not lost by that
// Units      s
// Threads    free functions
// Source     METHOD.md, Time of the torque channel

#include <optional>

#include "engine/data/recording.hpp"
#include "engine/infer/pipeline/recorded_loop.hpp"
#include "engine/infer/search/late_torque.hpp"
#include "engine/infer/search/selection.hpp"

namespace torquescope {

// Whether a torque that is so late, beside what was taken out before, may have been read there: after its row no later
// than a sample for all that is known (one-sided 95 %), before it none, half or a whole one
bool is_timing(LateTorque const& found, double already_s, double rate_hz);

// how late the torque is when it is within that; nothing when no delay is found, or one that is no timing
// is_unexplained: what was found does not explain the recording; already_s: what was taken out before
std::optional<double> delay_within_a_sample(Selection const& selection, bool is_unexplained, double already_s,
                                            double rate_hz);

// The torque as if it had been read late_s earlier, by a sinc of 16 samples under a Hann window: straight lines would
// take noise away that twins are to have. Before the first and after the last sample it stays
Recording with_torque_earlier(Recording recording, double late_s);

// Whether in the torque put back in time a law leaves more than twice the noise (variance) that as_read's left in the
// torque as it was read: then the rows are those in which the controller wrote it. Without a reference this is unknown:
// false
bool loses_the_law(RecordedLoop const& as_read, Recording const& in_time);

// for people: what was done to the recordings, a clause; the same as a sentence beside a verdict. "" where nothing was
std::string timing_remark(double late_s, double rate_hz);
std::string timing_sentence(double late_s, double rate_hz);

}  // namespace torquescope
