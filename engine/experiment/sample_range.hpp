#pragma once
// Samples that no machine can have: their squares, and those of the squares, would no longer be numbers.
//
// Errors     65 with the column and the row of the first one
// Threads    free functions

#include "engine/data/recording_reader.hpp"

namespace torquescope {

// of the columns that the job names, in SI units; what is not finite is for the reader of gaps
void refuse_huge_samples(RawTable const& table, RecordingOptions const& options);

}  // namespace torquescope
