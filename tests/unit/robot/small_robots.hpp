#pragma once
// Small robot files of the structure that people bring: how their makers write joints, branches and followers. The
// numbers are our own.

#include <string>

namespace torquescope::test {

// URDF
std::string six_joint_urdf();   // as UR10e: revolute joints, fixed frames before and behind
std::string hand_urdf();        // as Panda: seven joints, a hand with two fingers of which one follows
std::string continuous_urdf();  // as Kinova Gen3: every second joint turns without end
std::string quadruped_urdf();   // as Go2: a floating trunk, four legs of three joints, feet on fixed joints
std::string jaw_urdf();         // as SO-101: five joints and a jaw, a frame beside the jaw

// MJCF
std::string hand_mjcf();         // as Panda: default classes, a hand, an equality of its fingers
std::string seven_joint_mjcf();  // as iiwa: degrees, classes, quaternions
std::string jaw_mjcf();          // as SO-101: armature and friction in a class, position actuators
std::string quadruped_mjcf();    // as Go2: a free joint, legs of the same class

}  // namespace torquescope::test
