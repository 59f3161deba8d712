#pragma once
// Which effects a joint of an arm can have beside the arm's rigid links: [[model.effects]] of an arm's job.
//
// Threads    free function

#include <string>

#include "engine/effects/effect.hpp"

namespace torquescope {

// why it cannot; "" where it can
std::string why_not_beside_arm(Effect const& effect, JointKind joint);

}  // namespace torquescope
