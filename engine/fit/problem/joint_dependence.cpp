#include "engine/fit/problem/joint_dependence.hpp"

#include <cmath>

namespace torquescope {
namespace {

constexpr Eigen::Index postures = 8;

// angles, speeds and accelerations of about 1, without a relation to each other: multiples of the golden ratio
Motion postures_of(std::size_t joint, double shift) {
  constexpr double golden = 0.6180339887498949;
  auto const drawn = [&](std::size_t signal) {
    Eigen::VectorXd values(postures);
    for (Eigen::Index i = 0; i < postures; ++i) {
      auto const number = static_cast<double>(i + 1) + 17.0 * static_cast<double>(3 * joint + signal + 1) + shift;
      values[i] = 2.0 * (golden * number - std::floor(golden * number)) - 1.0;
    }
    return values;
  };
  Motion motion;
  motion.rate_hz = 1.0;
  motion.time_s = Eigen::VectorXd::LinSpaced(postures, 0.0, static_cast<double>(postures - 1));
  motion.q = drawn(0);
  motion.dq = drawn(1);
  motion.ddq = drawn(2);
  motion.torque = Eigen::VectorXd::Zero(postures);
  return motion;
}

}  // namespace

std::vector<std::vector<bool>> motion_dependence(ArmModel const& model) {
  constexpr double another_posture = 0.3, rounding = 1e-9;
  std::size_t const n = model.joints();
  std::vector<Motion> motion;
  for (std::size_t j = 0; j < n; ++j) motion.push_back(postures_of(j, 0.0));
  auto const before = model.rows(motion);
  std::vector<std::vector<bool>> depends(n, std::vector<bool>(n, true));
  for (std::size_t k = 0; k < n; ++k) {
    auto changed = motion;
    changed[k] = postures_of(k, another_posture);
    auto const after = model.rows(changed);
    for (std::size_t j = 0; j < n; ++j)
      depends[j][k] =
          j == k || (after[j] - before[j]).cwiseAbs().maxCoeff() > rounding * before[j].cwiseAbs().maxCoeff();
  }
  return depends;
}

}  // namespace torquescope
