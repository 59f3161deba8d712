#pragma once
// Where within a sample the torque channel was read: not known, not asked, and no fault.
//
// Why        twins hold the torque of a row from its sample to the next, as a controller does that runs at the rate of
//            the recording. A drive whose loop is faster than its log writes the torque of the instant, which comes
//            half a sample later to its motion, or the mean since the row before, a whole sample later; one that
//            computes for a sample is a whole one earlier. Nobody can tell that from a channel that is late by as much
// Lags       of a torque that acts after its row: none (held from the row on), half a sample or a whole one are what
//            simulations and programs make that log before or after a step. Any other one, beyond doubt and a tenth of
//            a sample, is no timing: a current loop or a filter (EMPS: 0.3 ms), which the search names like any law
// Rule       a delay that the search names, and that is for all that is known no more than one sample (and a tenth of
//            one, for what a current loop needs itself), is taken out of the recordings, and the search begins again;
//            also one that explains by itself nine tenths of what was named first, or of what comes closest: when a row
//            was read is asked before any physics. Where nothing explains the recording, any that may be timing is
//            taken out: torque beside its rows hides what is missing; but not where the controller's law is lost by
//            that. A longer one, or such a lag, is a finding
// Threads    free functions
// Units      s

#include <optional>

#include "engine/data/recording.hpp"
#include "engine/pipeline/recorded_loop.hpp"
#include "engine/search/forward_selection.hpp"
#include "engine/search/late_torque.hpp"

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
// torque as it was read: then the rows are those in which the controller wrote it. Without a reference nobody knows:
// false
bool loses_the_law(RecordedLoop const& as_read, Recording const& in_time);

// for people: what was done to the recordings, a clause; the same as a sentence beside a verdict. "" where nothing was
std::string timing_remark(double late_s, double rate_hz);
std::string timing_sentence(double late_s, double rate_hz);

}  // namespace torquescope
