#pragma once
// How a joint moves: about its axis or along it.

namespace torquescope {

enum class JointKind { revolute, prismatic };

}  // namespace torquescope
