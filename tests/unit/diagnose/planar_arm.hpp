#pragma once
// Two links in a vertical plane in closed form: motion given, torques by Lagrange's equations written out.
//
// Equation   tau_1 = M11 ddq_1 + M12 ddq_2 - h (2 dq_1 dq_2 + dq_2^2) + g ((m1 c1 + m2 l1) cos q_1 + m2 c2 cos q_12)
//            tau_2 = M12 ddq_1 + M22 ddq_2 + h dq_1^2 + g m2 c2 cos q_12, h = m2 l1 c2 sin q_2
// Friction   viscous, and Coulomb friction with the sign of the speed, in both joints; beside them an effect of one
//            joint
// Source     Spong, Hutchinson, Vidyasagar 2006, Robot Modeling and Control, section 7.4, ISBN 978-0-471-64990-8

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "engine/base/random_stream.hpp"
#include "engine/fit/problem/arm_model.hpp"
#include "engine/fit/problem/recorded_arm.hpp"

namespace torquescope::test {

struct PlanarArm {
  // of joint `at`, from its position, its speed and what the links ask of it; none
  std::function<double(double q, double dq, double load)> effect{};
  std::size_t at = 1;
  double noise = 0.03, encoder_step = 2e-5;
  double pace = 1.0;  // another recording of the same arm moves at another one
  std::uint64_t seed = 1;
};

struct PlanarInstant {
  double q[2], dq[2], ddq[2];
};

inline PlanarInstant planar_instant(PlanarArm const& arm, double t) {
  struct Wave {
    double size, hz, shift;
  };
  constexpr Wave waves[2][3] = {{{0.7, 0.21, 0.4}, {0.3, 0.57, 1.0}, {0.1, 1.21, 2.0}},
                                {{0.8, 0.17, 1.4}, {0.4, 0.47, 0.3}, {0.12, 1.37, 0.9}}};
  PlanarInstant at{};
  for (int j = 0; j < 2; ++j)
    for (auto const& [size, hz, shift] : waves[j]) {
      double const turns = 2.0 * std::numbers::pi * hz * arm.pace, angle = turns * t + shift;
      at.q[j] += size * std::sin(angle);
      at.dq[j] += size * turns * std::cos(angle);
      at.ddq[j] -= size * turns * turns * std::sin(angle);
    }
  return at;
}

struct PlanarTorque {
  double of[2];
};

inline PlanarTorque planar_torque(PlanarArm const& arm, double t) {
  constexpr double m1 = 6.0, m2 = 4.0, l1 = 0.5, c1 = 0.22, c2 = 0.25, i1 = 0.3, i2 = 0.15, g = 9.81;
  constexpr double viscous[2] = {3.0, 1.5}, coulomb[2] = {2.0, 1.2}, offset[2] = {0.3, -0.2};
  auto const [q, dq, ddq] = planar_instant(arm, t);
  double const m22 = i2 + m2 * c2 * c2, m12 = m22 + m2 * l1 * c2 * std::cos(q[1]);
  double const m11 = i1 + m1 * c1 * c1 + m2 * l1 * l1 + 2.0 * m12 - m22, h = m2 * l1 * c2 * std::sin(q[1]);
  double const weight = g * m2 * c2 * std::cos(q[0] + q[1]);
  double const load[2] = {m11 * ddq[0] + m12 * ddq[1] - h * (2.0 * dq[0] * dq[1] + dq[1] * dq[1]) +
                              g * (m1 * c1 + m2 * l1) * std::cos(q[0]) + weight,
                          m12 * ddq[0] + m22 * ddq[1] + h * dq[0] * dq[0] + weight};
  PlanarTorque torque{};
  for (std::size_t j = 0; j < 2; ++j) {
    torque.of[j] = load[j] + viscous[j] * dq[j] + coulomb[j] * std::copysign(1.0, dq[j]) + offset[j];
    if (arm.effect && arm.at == j) torque.of[j] += arm.effect(q[j], dq[j], load[j]);
  }
  return torque;
}

inline RecordedArm recorded(PlanarArm const& arm, double duration_s = 20.0, double rate_hz = 200.0) {
  auto const n = static_cast<Eigen::Index>(duration_s * rate_hz);
  RecordedArm made;
  for (int j = 0; j < 2; ++j) {
    Recording joint;
    joint.name = "planar";
    joint.rate_hz = rate_hz;
    joint.time_s = joint.position = joint.torque = Eigen::VectorXd::Zero(n);
    joint.rows.encoder_step = arm.encoder_step;
    made.joints.push_back(std::move(joint));
  }
  RandomStream random({arm.seed, 0, RandomDomain::test}, 0, 0);
  for (Eigen::Index k = 0; k < n; ++k) {
    double const t = static_cast<double>(k) / rate_hz;
    auto const at = planar_instant(arm, t);
    auto const torque = planar_torque(arm, t);
    for (std::size_t j = 0; j < 2; ++j) {
      Recording& joint = made.joints[j];
      joint.time_s[k] = t;
      joint.position[k] = arm.encoder_step * std::round(at.q[j] / arm.encoder_step);
      joint.torque[k] = torque.of[j] + arm.noise * random.normal();
    }
  }
  return made;
}

inline SerialChain planar_chain() {
  SerialChain chain;
  chain.name = "planar";
  chain.gravity = {0.0, -9.81, 0.0};
  chain.joints.resize(2);
  chain.joints[1].a = 0.5;
  return chain;
}

}  // namespace torquescope::test
