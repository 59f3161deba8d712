#pragma once
// The whole search on one recording: rows that move one way, time of the torque channel within a sample, reversals.
//
// Threads    as the stages
// Errors     as select_effects
// Source     METHOD.md, The search

#include "engine/search/abstention.hpp"
#include "engine/search/forward_selection.hpp"

namespace torquescope {

// recording: the setting's; its torque is put back in time where it was read within a sample of its rows
// (channel_timing.hpp). late_s: how much earlier it is now. The setting keeps the loop that was found in the torque as
// it was read where the controller's law is lost by that, and says whether twins read their torque noise from what
// models leave
Selection search_in_time(StageSetting& setting, Recording& recording, SelectionOptions const& options,
                         StageSink const& progress, double& late_s);

// What has no name may be noise: what acts from outside with a memory, or comes through a loop that is faster than its
// log, is louder at a few hertz than the law tells. Where nothing is missing among twins whose noise is read from what
// the model leaves (torque_colour.hpp), noise of that colour has such a spectrum, and what is left does not follow the
// motion (motion_echo.hpp), these are the selection; the setting's reads_colour says so
Selection doubt_noise(StageSetting& setting, SelectionOptions const& options, Selection selection,
                      StageSink const& progress);

// What the names leave; where that has no structure of its own, the reversals are looked at as well
// (friction_buildup.hpp). What these say must not cost the names that hold without them. The setting and the selection
// are those of the rows in the end
Remainder judge_with_reversals(StageSetting& setting, SelectionOptions const& options, Selection& selection,
                               StageSink const& progress);

}  // namespace torquescope
