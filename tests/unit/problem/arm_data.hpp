#pragma once
// Rows of the five joints of the CRS A465 with synthetic masses: torques by the inverse dynamics of whole links, not by
// the regressor; friction and noise of every joint.

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/random_stream.hpp"
#include "engine/fit/problem/recorded_rows.hpp"
#include "engine/robot/inverse_dynamics.hpp"
#include "engine/robot/robot_registry.hpp"

namespace torquescope::test {

inline std::vector<std::string> const friction{"viscous", "coulomb", "offset"};
inline std::vector<double> const joint_noise{0.4, 0.9, 0.3, 0.05, 0.02};  // N m

inline SerialChain crs_chain() {
  return read_robot(std::filesystem::path(TORQUESCOPE_SOURCE_DIR) / "jobs/robots/crs_a465.toml");
}

inline ArmModel crs(ArmTerms const& terms = {friction}) { return {crs_chain(), terms, Section{"model", {}, {}}}; }

// three incommensurate sines a joint, all joints different
inline std::vector<Motion> motion_of(std::size_t joints, Eigen::Index n, std::uint32_t draw) {
  std::vector<Motion> motion(joints);
  for (std::size_t j = 0; j < joints; ++j) {
    auto& one = motion[j];
    one.rate_hz = 50.0;
    for (auto signal : {&Motion::time_s, &Motion::q, &Motion::dq, &Motion::ddq, &Motion::torque})
      (one.*signal).setZero(n);
    RandomStream random({1, draw, RandomDomain::test}, 0, static_cast<std::uint32_t>(j));
    for (int k = 0; k < 3; ++k) {
      double const w = random.uniform(1.0, 5.0), phase = random.uniform(0.0, 6.28), amplitude = 1.2 / w;
      for (Eigen::Index i = 0; i < n; ++i) {
        one.time_s[i] = static_cast<double>(i) / one.rate_hz;
        double const x = w * one.time_s[i] + phase;
        one.q[i] += amplitude * std::sin(x);
        one.dq[i] += amplitude * w * std::cos(x);
        one.ddq[i] -= amplitude * w * w * std::sin(x);
      }
    }
  }
  return motion;
}

inline double friction_torque(std::size_t joint, double dq) {
  double const j = static_cast<double>(joint) + 1.0;
  return 0.7 / j * dq + 1.1 / j * (dq > 0.0 ? 1.0 : -1.0) - 0.1 * j;
}

// of these links; friction beside them
inline void add_torque(SerialChain const& chain, std::vector<Motion>& motion) {
  auto const parameters = standard_parameters(chain, DriveInertias::included);
  auto const joints = static_cast<Eigen::Index>(motion.size());
  Eigen::VectorXd q(joints), dq(joints), ddq(joints);
  for (Eigen::Index i = 0; i < motion.front().q.size(); ++i) {
    for (Eigen::Index j = 0; j < joints; ++j) {
      auto const& one = motion[static_cast<std::size_t>(j)];
      q[j] = one.q[i];
      dq[j] = one.dq[i];
      ddq[j] = one.ddq[i];
    }
    Eigen::VectorXd const tau = inverse_dynamics(chain, parameters, q, dq, ddq);
    for (Eigen::Index j = 0; j < joints; ++j)
      motion[static_cast<std::size_t>(j)].torque[i] = tau[j] + friction_torque(static_cast<std::size_t>(j), dq[j]);
  }
}

// common: share of each joint's variance that all joints have together
inline void add_noise(std::vector<Motion>& motion, std::uint32_t draw, double common = 0.0) {
  for (Eigen::Index i = 0; i < motion.front().q.size(); ++i) {
    double const shared = RandomStream({2, draw, RandomDomain::test}, static_cast<std::uint32_t>(i), 99).normal();
    for (std::size_t j = 0; j < motion.size(); ++j) {
      double const own =
          RandomStream({2, draw, RandomDomain::test}, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j))
              .normal();
      motion[j].torque[i] += joint_noise[j] * (std::sqrt(common) * shared + std::sqrt(1.0 - common) * own);
    }
  }
}

inline std::vector<std::vector<bool>> all_move(std::vector<Motion> const& motion) {
  return {motion.size(), std::vector<bool>(static_cast<std::size_t>(motion.front().q.size()), true)};
}

inline RecordedRows rows_of(ArmModel const& model, std::vector<Motion> const& motion,
                            std::optional<std::size_t> payload = {}) {
  return make_recorded_rows("x.csv", motion, all_move(motion), {.edge_s = 0.0}, model, Section{"filter", {}, {}},
                            payload);
}

}  // namespace torquescope::test
