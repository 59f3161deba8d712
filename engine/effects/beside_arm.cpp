#include "engine/effects/beside_arm.hpp"

namespace torquescope {

std::string why_not_beside_arm(Effect const& effect, JointKind joint) {
  if (effect.is_given() || effect.is_of_whole_arm()) return "it acts on several joints";
  if (effect.is_rigid_body()) return "it is part of the rigid arm already";
  if (effect.acts_on() != ActsOn::joint) return "it acts on a recorded channel, not in the joint";
  if (effect.is_event()) return "it begins at an instant of one recording";
  if (!effect.exists_on(joint)) return "it needs an angle, and the joint slides";
  return "";
}

}  // namespace torquescope
