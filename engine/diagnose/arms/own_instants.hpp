#pragma once
// When an effect of known size acts in a recording: between the instants of its own at which it explains most there.
//
// Equation   largest sum of |left|^2 - |left - torque|^2 over rows that follow each other, cut between instants
// Null       of replicates the same with instants of their own: what the effect leaves there, each stretch with a
//            random sign. The freedom of two instants is theirs as well (whole_arm_scan.hpp)
// Shapes     n rows of one recording: `left` without the effect, `torque` of the effect where it acts
// Threads    free function; same bits always

#include <optional>

#include "engine/diagnose/arms/whole_arm_fit.hpp"

namespace torquescope {

struct OwnInstants {
  std::optional<ActingTime> time{};  // none: it acts nowhere, as far as chance lets tell
  Eigen::VectorXd torque{};          // n: zero where it does not act
};

// recording: the number that ActingTime gets; setting: of the replicates
OwnInstants own_instants(WholeArmRows const& rows, std::size_t recording, Eigen::VectorXd const& left,
                         Eigen::VectorXd const& torque, double alpha, ScanSetting const& setting);

}  // namespace torquescope
