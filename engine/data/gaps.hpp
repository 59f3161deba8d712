#pragma once
// Values that are not numbers (NaN, infinite, empty cells) in the channels of a recording.
//
// gaps = "error"   Error 65: how many, in which line first, at what time
// gaps = "fill"    runs of up to 5 between two numbers become a straight line over the rows; a longer run, or one at an
//                  end of the recording, is Error 65

#include <vector>

#include "engine/data/columns.hpp"

namespace torquescope {

inline constexpr std::size_t longest_filled_gap = 5;

// returns what was filled
std::vector<DataWarning> close_gaps(Channels& channels, RawTable const& table, RecordingOptions const& options);

}  // namespace torquescope
