#pragma once
// Channels that have a clock of their own (recording.clocks), put into one table of rows in the order of time.
//
// Rows       one for each stamp of any of the clocks; a channel is empty (NaN) where its clock has no row. Who needs a
//            value there interpolates it, as of topics that were merged into one file (health/make_recording.cpp)
// Columns    the channels and the clock of the position alone: nobody says on which clock the others stand
// Units      those of the file; all clocks count in one unit
// Errors     Error 78: a clock of an unknown channel, no such column, no columns.time; 65: a value without its stamp, a
//            clock that runs backwards, more numbers than a recording may hold
// Threads    free function

#include "engine/data/columns.hpp"

namespace torquescope {

RawTable on_one_clock(RawTable const& table, RecordingOptions const& options, Section const& section,
                      TorqueColumn torque);

}  // namespace torquescope
