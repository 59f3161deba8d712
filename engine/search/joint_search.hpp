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

// Before "unexplained": the search among replicates whose torque noise is read from the residual (torque_colour.hpp).
// It replaces the selection, and sets reads_colour, when nothing is missing there, the spectrum fits, and the residual
// does not follow the motion (METHOD.md, Noise read from the residual)
Selection doubt_noise(StageSetting& setting, SelectionOptions const& options, Selection selection,
                      StageSink const& progress);

// What the accepted effects leave; where that has no structure of its own, reversals are looked at as well
// (friction_buildup.hpp), which must not cost effects that hold without them. Setting and selection become those of the
// final rows
Remainder judge_with_reversals(StageSetting& setting, SelectionOptions const& options, Selection& selection,
                               StageSink const& progress);

}  // namespace torquescope
