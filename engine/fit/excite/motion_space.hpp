#pragma once
// A box whose every point is a Fourier motion within the joints' limits: what an optimiser searches.
//
// Point      of each joint 2 (K - 1) coefficients in [-1, 1], whose last harmonics follow from the start at rest; its
//            place in the range that its size leaves, and its size, a share of the largest that the limits allow
// Promise    |dq| and |ddq| stay below their limits and q within its own at every instant, not at samples alone: on n
//            equal steps of a period a polynomial of K harmonics shows at least cos(pi K / n) of its largest value
// Units      as fourier_motion.hpp
// Errors     Error 78: a joint with neither a range nor a speed that bounds its motion
// Threads    const object, any number of threads
// Source     M. Riesz 1914, and Ehlich and Zeller 1964, doi:10.1007/BF01111276 (the largest value between samples)

#include <span>

#include "engine/fit/excite/fourier_motion.hpp"
#include "engine/fit/optim/objective.hpp"
#include "engine/robot/serial_chain.hpp"

namespace torquescope {

// of the limits, which motions may use
struct LimitShares {
  double position = 1.0, speed = 1.0, acceleration = 1.0;
};

class MotionSpace {
 public:
  MotionSpace(SerialChain const& chain, LimitShares const& shares, Eigen::Index harmonics, double period_s);

  Bounds const& bounds() const { return bounds_; }
  FourierMotion motion(std::span<double const> point) const;

 private:
  struct JointLimits {
    double lower, upper, speed, acceleration;
  };
  FourierJoint joint_motion(std::span<double const> point, JointLimits const& limits) const;

  std::vector<JointLimits> limits_;
  Eigen::Index harmonics_;
  double period_s_;
  FourierTable table_;
  double hidden_;  // largest value between samples, over the largest one of samples
  Bounds bounds_;
};

}  // namespace torquescope
