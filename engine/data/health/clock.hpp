#pragma once
// The time stamps of a recording as seconds that rise: unit, order of the rows, counters that roll over, bursts.
//
// Corrected  the unit where the column's name or the size of the stamps (time since 1970) tells it; rows that stand
//            some places away from where their stamp belongs; a counter that falls by its own modulus; rows that were
//            stamped when a packet of them arrived, which stand evenly over their number
// Refused    Error 65: a step of a tenth of a second and more where nothing tells the unit; stamps that start anew
// Threads    free function

#include "engine/data/health/examination.hpp"

namespace torquescope {

// permutes the channels into the order of time and fills time_s (s since the first row); needs a time channel
void examine_clock(Examination& exam);

// Takes steps of the clock out of time_s over which the position goes on from row to row as if nothing had happened,
// while the joint moves: the clock was set, no row is missing. Needs a position without wraps and wrong rows
void close_set_clock(Examination& exam);

}  // namespace torquescope
