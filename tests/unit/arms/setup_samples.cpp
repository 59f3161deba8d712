#include "unit/arms/setup_samples.hpp"

#include <cmath>
#include <numbers>

#include "engine/robot/inverse_dynamics.hpp"

namespace torquescope::test {
namespace {

LinkInertia body(double mass, Eigen::Vector3d const& centre) {
  return LinkInertia::from_centre(mass, centre, 0.01 * mass * Eigen::Matrix3d::Identity());
}

}  // namespace

SerialChain small_arm(bool with_masses) {
  constexpr double right = 0.5 * std::numbers::pi;
  SerialChain chain;
  chain.joints.resize(4);
  double const alpha[] = {0.0, -right, 0.0, right}, a[] = {0.0, 0.05, 0.4, 0.03}, d[] = {0.3, 0.0, 0.02, 0.35};
  double const gears[] = {100.0, 120.0, 80.0, 50.0};
  for (std::size_t j = 0; j < 4; ++j) {
    chain.joints[j].name = "joint_" + std::to_string(j + 1);
    chain.joints[j].alpha = alpha[j];
    chain.joints[j].a = a[j];
    chain.joints[j].d = d[j];
    chain.joints[j].gear_ratio = gears[j];
    chain.joints[j].drive_inertia = 0.02;
  }
  if (with_masses)
    chain.links = {body(4.0, {0.0, 0.02, 0.05}), body(3.0, {0.2, 0.01, 0.03}), body(2.0, {0.02, -0.15, 0.01}),
                   body(1.0, {0.06, 0.02, 0.05})};
  return chain;
}

ArmSamples small_arm_moved(double load_kg, double load_from_s) {
  constexpr Eigen::Index n = 1000, joints = 4;
  constexpr double step_s = 0.03;
  SerialChain const chain = small_arm(true);
  Eigen::VectorXd const empty = standard_parameters(chain, DriveInertias::included);
  SerialChain loaded = chain;
  loaded.links.back() = loaded.links.back() + body(load_kg, {0.1, 0.05, 0.1});
  Eigen::VectorXd const full = standard_parameters(loaded, DriveInertias::included);
  ArmSamples samples;
  for (auto* channel : {&samples.q, &samples.dq, &samples.ddq, &samples.tau}) channel->resize(n, joints);
  samples.moves = Eigen::MatrixXd::Ones(n, joints);
  samples.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, (n - 1) * step_s);
  samples.begins = {0};
  for (Eigen::Index k = 0; k < n; ++k) {
    double const t = samples.time_s[k];
    for (Eigen::Index j = 0; j < joints; ++j) {
      auto const number = static_cast<double>(j + 1);
      double const slow = 0.7 + 0.31 * number, fast = 2.1 + 0.47 * number;
      samples.q(k, j) = 0.8 * std::sin(slow * t + number) + 0.3 * std::sin(fast * t);
      samples.dq(k, j) = 0.8 * slow * std::cos(slow * t + number) + 0.3 * fast * std::cos(fast * t);
      samples.ddq(k, j) = -0.8 * slow * slow * std::sin(slow * t + number) - 0.3 * fast * fast * std::sin(fast * t);
    }
    Eigen::VectorXd const dq = samples.dq.row(k);
    Eigen::VectorXd const torque = inverse_dynamics(chain, load_kg > 0.0 && t >= load_from_s ? full : empty,
                                                    samples.q.row(k).transpose(), dq, samples.ddq.row(k).transpose());
    samples.tau.row(k) = (torque.array() + 0.5 * dq.array() + 0.3 * dq.array().sign()).transpose();
  }
  return samples;
}

}  // namespace torquescope::test
