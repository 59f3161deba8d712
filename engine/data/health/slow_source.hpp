#pragma once
// Channels whose source is slower than the log: a drive that refreshes its values every 15 ms in a log of 1 kHz.
//
// Each channel by itself: its rate and the phase of its clock are its own. A value is as old as the first row of its
// run, so that row is its sample; the rows that repeat it become missing. A command is not looked at: a drive does
// follow a command that holds.
// Requires   the times of the rows are known, the position is unwrapped
// Threads    free function

#include "engine/data/health/examination.hpp"

namespace torquescope {

void examine_slow_sources(Examination& exam);

}  // namespace torquescope
