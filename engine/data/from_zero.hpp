#pragma once
// The recording with its time beginning at 0.
//
// Threads    pure function

#include "engine/data/recording.hpp"

namespace torquescope {

inline Recording from_zero(Recording recording) {
  double const start = recording.time_s.size() > 0 ? recording.time_s[0] : 0.0;
  recording.time_s.array() -= start;
  return recording;
}

}  // namespace torquescope
