#pragma once
// A torque column that holds what was asked for, while the drive gives no more than a limit.
//
// Equation   column = torque of the motion + a max(column - L, 0) + b min(column + M, 0); a = b = 1 of such a command,
//            both columns filtered like the torque; L and M by a scan of the levels, one side or both
// Told       the error falls by a third and beyond chance (of the scan), a and b are one, the motion leaves a tenth of
//            what is asked beyond the limit, the drive gives torque of both signs, and kinks at other levels beside
//            these explain next to nothing more: an effect that bends with the torque is no limit
// Units      N m or N
// Threads    pure function

#include <optional>

#include "engine/fit/problem/torque_beside_motion.hpp"

namespace torquescope {

struct CommandLimit {
  std::optional<double> upper{}, lower{};        // L and -M; one of them at least
  double error_before = 0.0, error_after = 0.0;  // of the torque, relative
  Eigen::Index rows = 0;                         // samples that ask for more
};

// torque: [n] as recorded
std::optional<CommandLimit> command_limit(TorqueBesideMotion const& beside, Eigen::VectorXd const& torque);

// what the drive gave
Eigen::VectorXd limited(Eigen::VectorXd const& torque, CommandLimit const& limit);

}  // namespace torquescope
