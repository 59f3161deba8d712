#include "engine/data/spline_motion.hpp"

#include <utility>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

// second derivatives at the knots: the tridiagonal system is solved from the left, then back
Eigen::VectorXd spline_curvature(Eigen::VectorXd const& q, double rate_hz) {
  Eigen::Index const n = q.size();
  Eigen::VectorXd curvature = Eigen::VectorXd::Zero(n), above = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 1; k + 1 < n; ++k) {
    double const difference = 6.0 * rate_hz * rate_hz * ((q[k + 1] - q[k]) - (q[k] - q[k - 1]));
    above[k] = 1.0 / (4.0 - above[k - 1]);
    curvature[k] = (difference - curvature[k - 1]) * above[k];
  }
  for (Eigen::Index k = n - 2; k > 0; --k) curvature[k] -= above[k] * curvature[k + 1];
  return curvature;
}

}  // namespace

Motion spline_motion(Recording&& recording) {
  Eigen::Index const n = recording.position.size();
  TORQUESCOPE_EXPECT(n >= 3 && recording.torque.size() == n);
  Motion motion;
  motion.rate_hz = recording.rate_hz;
  motion.time_s = std::move(recording.time_s);
  motion.torque = std::move(recording.torque);
  motion.ddq = spline_curvature(recording.position, motion.rate_hz);
  motion.q = std::move(recording.position);
  double const step_s = 1.0 / motion.rate_hz;
  motion.dq.resize(n);
  // the slope at the left end of a piece from its chord and curvatures; the last sample is a right end
  auto const chord = [&](Eigen::Index k) { return (motion.q[k + 1] - motion.q[k]) * motion.rate_hz; };
  for (Eigen::Index k = 0; k + 1 < n; ++k)
    motion.dq[k] = chord(k) - step_s * (2.0 * motion.ddq[k] + motion.ddq[k + 1]) / 6.0;
  motion.dq[n - 1] = chord(n - 2) + step_s * (motion.ddq[n - 2] + 2.0 * motion.ddq[n - 1]) / 6.0;
  return motion;
}

}  // namespace torquescope
