#pragma once
// Values that are not numbers (NaN, infinite, empty cells) in the channels of a recording.
//
// gaps = "error"   Error 65: how many, in which line first, at what time
// gaps = "fill"    a warning for each channel; what becomes of them is decided with the grid
//                  (health/make_recording.cpp)

#include <vector>

#include "engine/data/columns.hpp"

namespace torquescope {

inline constexpr double longest_filled_gap = 5;  // samples

// turns infinite values into NaN, and says how many are missing
std::vector<DataWarning> missing_values(Channels& channels, RawTable const& table, RecordingOptions const& options);

}  // namespace torquescope
