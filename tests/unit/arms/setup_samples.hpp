#pragma once
// Recordings of a small arm for tests of its set-up: a vertical first joint, a shoulder, an elbow and a wrist across.

#include <Eigen/Core>

#include "engine/diagnose/arms/arm_setup.hpp"

namespace torquescope::test {

// four joints with masses and drives of known inertia
SerialChain small_arm(bool with_masses);

// 30 s of sums of two sines at 100 Hz; torques by inverse dynamics with viscous and Coulomb friction. load_kg: of the
// last link from load_from_s on
ArmSamples small_arm_moved(double load_kg = 0.0, double load_from_s = 0.0);

}  // namespace torquescope::test
