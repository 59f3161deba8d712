#pragma once
// Rows at the end that were allocated and never written: zeros, or no number, in every column.
//
// Told by    a column that never falls and is above zero up to there (the clock), and is zero from there on; every
//            other column is zero there too, or counts the rows to the end. Rows without any number need no clock
// Threads    functions of their arguments

#include "engine/data/recording_reader.hpp"

namespace torquescope {

// drops them and adds a remark
void drop_unwritten_tail(RawTable& table);

}  // namespace torquescope
