#pragma once
// One recording of an arm: a Recording per joint, all on one clock, and what the arm carried.
//
// Threads    plain record

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "engine/data/recording.hpp"

namespace torquescope {

// [n][N] what a wrench at the tip gives to the joints; empty: there is none
struct OutsideTorques {
  Eigen::MatrixXd as_read, otherwise;  // in the other frame of the two that it may have
};

struct RecordedArm {
  std::vector<Recording> joints;         // from the base to the tip
  std::optional<std::size_t> payload{};  // which of the model's
  // of a wrench at the tip: a recording of each of its six columns, as external_torque; none
  std::vector<Recording> wrench{};
  OutsideTorques outside{};
};

}  // namespace torquescope
