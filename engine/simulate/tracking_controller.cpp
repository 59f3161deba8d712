#include "engine/simulate/tracking_controller.hpp"

#include <numbers>

#include "engine/base/contract.hpp"

namespace torquescope {

LoopController error_controller(double inertia, double bandwidth_hz, double rate_hz) {
  TORQUESCOPE_EXPECT(inertia > 0.0 && bandwidth_hz > 0.0 && bandwidth_hz <= 0.05 * rate_hz);
  double const omega = 2.0 * std::numbers::pi * bandwidth_hz;
  double const kp = inertia * omega * omega;
  double const kd = 2.0 * inertia * omega * rate_hz;  // per difference of one sample
  LoopController controller;
  controller.position = {-kp - kd, kd};
  controller.reference = {-0.5 * kd, kp, 0.5 * kd};
  return controller;
}

LoopController tracking_controller(TrackedJoint const& joint, double bandwidth_hz, TrackedMotion const& motion) {
  double const rate_hz = motion.rate_hz;
  TORQUESCOPE_EXPECT(motion.slow > 0.0);
  LoopController controller = error_controller(joint.inertia, bandwidth_hz, rate_hz);
  double const accelerate = joint.inertia * rate_hz * rate_hz;  // per second difference
  double const move = 0.5 * joint.viscous * rate_hz;            // per difference of two samples
  controller.reference[0] += accelerate - move;
  controller.reference[1] -= 2.0 * accelerate;
  controller.reference[2] += accelerate + move;
  controller.constant = 0.5 * (joint.forward + joint.backward);
  double const dry = 0.5 * (joint.forward - joint.backward);
  if (dry != 0.0) controller.terms.push_back({ReferenceShape::smooth_sign, 1, 2, motion.slow / rate_hz, dry});
  if (joint.gravity_sin != 0.0) controller.terms.push_back({ReferenceShape::sine, 0, 1, 1.0, joint.gravity_sin});
  if (joint.gravity_cos != 0.0) controller.terms.push_back({ReferenceShape::cosine, 0, 1, 1.0, joint.gravity_cos});
  return controller;
}

}  // namespace torquescope
