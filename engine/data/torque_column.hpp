#pragma once
// Whether recording.columns must name a torque: a simulation in its loop needs command and position alone.

namespace torquescope {

enum class TorqueColumn { required, optional };

}  // namespace torquescope
