#pragma once
// A motion of addressed random states: both directions, rest included, nothing collinear.

#include "engine/base/random_stream.hpp"
#include "engine/data/motion.hpp"

namespace torquescope::test {

inline Motion rich_motion(Eigen::Index n) {
  RandomStream random({7, 0, RandomDomain::test}, 0, 0);
  Motion motion;
  motion.rate_hz = 100.0;
  motion.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, 0.01 * static_cast<double>(n - 1));
  motion.q.resize(n);
  motion.dq.resize(n);
  motion.ddq.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    motion.q[i] = random.uniform(-2.0, 2.0);
    motion.dq[i] = i % 10 == 0 ? 0.0 : random.uniform(-3.0, 3.0);
    motion.ddq[i] = random.uniform(-9.0, 9.0);
  }
  motion.torque = Eigen::VectorXd::Zero(n);
  return motion;
}

inline JointState state_at(Motion const& motion, Eigen::Index i) {
  return {motion.time_s[i], motion.q[i], motion.dq[i], motion.ddq[i]};
}

}  // namespace torquescope::test
