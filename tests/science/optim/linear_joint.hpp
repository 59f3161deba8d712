#pragma once
// The seed's problem in closed form: one joint, tau = a1 ddq + a2 dq + a3 [dq > 0] + a4 [dq < 0], noise 0.3, n = 2000.
//
// With M = Phi' Phi / n and a the least squares estimate, MSE(b) = MSE(a) + (b - a)' M (b - a) exactly. So a fitness
// costs 16 products instead of 2000 residuals, and the gap to least squares is known without cancellation.

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>

#include "engine/base/random_stream.hpp"
#include "engine/fit/optim/objective.hpp"

namespace torquescope::testing {

struct LinearJoint {
  std::array<std::array<double, 4>, 4> M{};
  std::array<double, 4> ols{};
  double mse_ols = 0.0;

  double gap(std::span<double const> b) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) sum += (b[i] - ols[i]) * M[i][j] * (b[j] - ols[j]);
    }
    return sum;
  }
  double mse(std::span<double const> b) const { return mse_ols + gap(b); }
};

// solves A x = b by Gauss elimination with pivots; 4 x 4
inline std::array<double, 4> solve(std::array<std::array<double, 4>, 4> A, std::array<double, 4> b) {
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 4; ++i) pivot = std::fabs(A[i][k]) > std::fabs(A[pivot][k]) ? i : pivot;
    std::swap(A[k], A[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < 4; ++i) {
      double const factor = A[i][k] / A[k][k];
      for (std::size_t j = k; j < 4; ++j) A[i][j] -= factor * A[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = 4; k-- > 0;) {
    for (std::size_t j = k + 1; j < 4; ++j) b[k] -= A[k][j] * b[j];
    b[k] /= A[k][k];
  }
  return b;
}

// a joint within the speed (3.14 rad/s) and acceleration (12.6 rad/s2) limits of the CRS A465: three sines over 10 s
inline LinearJoint make_linear_joint() {
  constexpr int n = 2000;
  constexpr double sigma = 0.3;
  constexpr std::array<double, 4> truth{0.0036, 0.0164, 0.0089, -0.2582};
  RandomStream noise({1, 0, RandomDomain::test}, 0, 0);
  LinearJoint joint;
  std::array<double, 4> Phi_tau{};
  double tau_tau = 0.0;
  for (int k = 0; k < n; ++k) {
    double const t = 10.0 * k / n;
    double dq = 0.0;
    double ddq = 0.0;
    for (auto const& [cycles, amplitude] : {std::array{2.0, 1.4}, std::array{5.0, 1.0}, std::array{9.0, 0.7}}) {
      double const omega = 2.0 * std::numbers::pi * cycles / 10.0;
      dq += amplitude * std::sin(omega * t + cycles);
      ddq += amplitude * omega * std::cos(omega * t + cycles);
    }
    std::array<double, 4> const row{ddq, dq, dq > 0.0 ? 1.0 : 0.0, dq < 0.0 ? 1.0 : 0.0};
    double tau = sigma * noise.normal();
    for (std::size_t i = 0; i < 4; ++i) tau += truth[i] * row[i];
    for (std::size_t i = 0; i < 4; ++i) {
      Phi_tau[i] += row[i] * tau / n;
      for (std::size_t j = 0; j < 4; ++j) joint.M[i][j] += row[i] * row[j] / n;
    }
    tau_tau += tau * tau / n;
  }
  joint.ols = solve(joint.M, Phi_tau);
  joint.mse_ols = tau_tau;
  for (std::size_t i = 0; i < 4; ++i) joint.mse_ols -= joint.ols[i] * Phi_tau[i];
  return joint;
}

}  // namespace torquescope::testing
