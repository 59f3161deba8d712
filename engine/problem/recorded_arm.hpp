#pragma once
// One recording of an arm: a Recording per joint, all on one clock, and what the arm carried.
//
// Threads    plain record

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/data/recording.hpp"

namespace torquescope {

struct RecordedArm {
  std::vector<Recording> joints;         // from the base to the tip
  std::optional<std::size_t> payload{};  // which of the model's
};

}  // namespace torquescope
