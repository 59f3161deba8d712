#pragma once
// Rows of a made-up recording and its replicates: known noise on a known motion, so that every planted mismatch is
// known.
//
// Motion     two sines of the position that share no period; rows at standstill are masked
// Noise      first-order autoregression in time with variance 1, gaps included; recording and replicates alike
// Units      rad, N m

#include <cmath>
#include <functional>
#include <numbers>

#include "engine/base/random_stream.hpp"
#include "engine/effects/joint_scales.hpp"
#include "engine/infer/locate/mismatch_rows.hpp"

namespace torquescope::test {

struct SyntheticPlan {
  Eigen::Index samples = 3000;  // kept, before the mask
  double rate_hz = 100.0;
  Eigen::Index replicates = 200;
  double memory = 0.0;    // of the noise: correlation of neighbours
  std::uint32_t set = 0;  // another recording
};

struct SyntheticRows {
  MismatchRows rows;
  JointScales scales;

  void plant(std::function<double(MismatchRows const&, Eigen::Index)> const& torque) {
    for (Eigen::Index i = 0; i < rows.size(); ++i) rows.residual[i] += torque(rows, i);
  }
};

inline Eigen::VectorXd synthetic_noise(SyntheticPlan const& plan, Eigen::Index column) {
  RandomStream stream({4711, plan.set, RandomDomain::test}, 0, static_cast<std::uint32_t>(column));
  double const fresh = std::sqrt(1.0 - plan.memory * plan.memory);
  Eigen::VectorXd noise(plan.samples);
  double value = stream.normal();
  for (double& one : noise) {
    value = plan.memory * value + fresh * stream.normal();
    one = value;
  }
  return noise;
}

inline SyntheticRows synthetic_rows(SyntheticPlan const& plan) {
  constexpr double two_pi = 2.0 * std::numbers::pi;
  double const slow = two_pi * 0.31, fast = two_pi * 0.83;
  SyntheticRows made;
  MismatchRows& rows = made.rows;
  rows.rate_hz = plan.rate_hz;
  Eigen::VectorXd const at =
      Eigen::VectorXd::LinSpaced(plan.samples, 0.0, static_cast<double>(plan.samples - 1) / plan.rate_hz);
  Eigen::VectorXd const q = 1.2 * (slow * at.array()).sin() + 0.2 * (fast * at.array()).sin();
  Eigen::VectorXd const dq = 1.2 * slow * (slow * at.array()).cos() + 0.2 * fast * (fast * at.array()).cos();
  Eigen::VectorXd const ddq =
      -1.2 * slow * slow * (slow * at.array()).sin() - 0.2 * fast * fast * (fast * at.array()).sin();
  Eigen::VectorXd const load = 0.3 * ddq.array() + 2.0 * q.array().sin();
  Eigen::VectorXd const model = load.array() + dq.array().sign() + 0.5 * dq.array();
  double const peak = dq.cwiseAbs().maxCoeff();

  Eigen::VectorXd since_velocity(plan.samples), since_torque(plan.samples);
  double velocity_distance = 0.0, torque_distance = 0.0;
  for (Eigen::Index k = 0; k < plan.samples; ++k) {
    if (k > 0 && dq[k] * dq[k - 1] < 0.0) velocity_distance = 0.0;
    if (k > 0 && model[k] * model[k - 1] < 0.0) torque_distance = 0.0;
    since_velocity[k] = velocity_distance += std::abs(dq[k]) / plan.rate_hz;
    since_torque[k] = torque_distance += std::abs(dq[k]) / plan.rate_hz;
    if (std::abs(dq[k]) > 0.01 * peak) rows.kept_rows.push_back(k);
  }
  rows.time_s = at(rows.kept_rows);
  rows.q = q(rows.kept_rows);
  rows.dq = dq(rows.kept_rows);
  rows.ddq = ddq(rows.kept_rows);
  rows.load_torque = load(rows.kept_rows);
  rows.model_torque = model(rows.kept_rows);
  rows.since_velocity_reversal = since_velocity(rows.kept_rows);
  rows.since_torque_reversal = since_torque(rows.kept_rows);
  rows.residual = synthetic_noise(plan, 0)(rows.kept_rows);
  rows.torque = rows.model_torque + rows.residual;
  rows.replicates.resize(rows.residual.size(), plan.replicates);
  for (Eigen::Index t = 0; t < plan.replicates; ++t)
    rows.replicates.col(t) = synthetic_noise(plan, t + 1)(rows.kept_rows);
  rows.replicate_mean = rows.replicates.rowwise().mean();

  JointScales& scales = made.scales;
  scales.duration_s = static_cast<double>(plan.samples) / plan.rate_hz;
  scales.rate_hz = plan.rate_hz;
  scales.cutoff_hz = 0.4 * plan.rate_hz;
  scales.peak_speed = peak;
  scales.position_range = q.maxCoeff() - q.minCoeff();
  scales.encoder_step = 1e-4;
  return made;
}

}  // namespace torquescope::test
