#pragma once
// The whole search on one recording: names among the rows that move one way, the torque channel's time within a sample, and the
// reversals.
//
// Threads    as the stages
// Errors     as select_effects

#include "engine/diagnose/abstention.hpp"
#include "engine/diagnose/forward_selection.hpp"

namespace torquescope {

// recording: the setting's; its torque is put back in time where it was read within half a sample of its rows
// (channel_timing.hpp). late_s: how much earlier it is now
Selection search_in_time(StageSetting const& setting, Recording& recording, SelectionOptions const& options,
                         StageSink const& progress, double& late_s);

// What the names leave; where that has no structure of its own, the reversals are looked at as well (friction_buildup.hpp). What
// these say must not cost the names that hold without them. The setting and the selection are those of the rows in the end
Remainder judge_with_reversals(StageSetting& setting, SelectionOptions const& options, Selection& selection,
                               StageSink const& progress);

}  // namespace torquescope
