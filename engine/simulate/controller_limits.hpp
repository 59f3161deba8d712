#pragma once
// Where the torque of a recording stops following its controller because the controller could not ask for more.
//
// Rule       the rows where the controller asks for most, as many as one common level explains better than the
//            controller does: their mean is the limit, unless six deviations of the noise do not tell the two apart or
//            a larger torque was reached
// Units      of the torque
// Shapes     rows ascend
// Threads    free functions

#include <cmath>
#include <limits>

#include "engine/simulate/controller_regression.hpp"

namespace torquescope {

struct ControllerLimits {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool any() const { return std::isfinite(least) || std::isfinite(most); }
};

// The inner part of the torque's range, where no limit can be. Choosing rows by the torque itself biases a little,
// hence only for the first looks: alignment and limits.
SampleRows inner_rows(LoopSignals const& signals, SampleRows const& rows);

ControllerLimits find_limits(LoopSignals const& signals, ControllerRegression const& fit, SampleRows const& rows);

// rows where the controller asks for less than the limits: told by what it sees, not by the torque
SampleRows unclipped_rows(LoopSignals const& signals, ControllerRegression const& fit, ControllerLimits const& limits,
                          SampleRows const& rows);

}  // namespace torquescope
