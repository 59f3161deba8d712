#pragma once
// Functions to search, shifted and turned by an instance's own numbers; the minimum is 0, in a box of -5 .. 5.
//
// Equation   z = Q (x - x_0), Q orthogonal of normal numbers, x_0 uniform in -4 .. 4; Rastrigin and Rosenbrock both as
//            they are and turned, there z + 1 is Rosenbrock's argument
//            gallagher: 1 - max_k w_k exp(-|z - y_k|^2 / (2 D s_k^2)), 101 peaks, w_0 = 1 at z = 0, others 0.11 .. 0.91
// Source     after Hansen, Finck, Ros, Auger: Real-parameter black-box optimization benchmarking 2009, INRIA RR-6829;
//            without their transformations of values and places, so not their numbers

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/base/dense_solvers.hpp"
#include "support/optimise.hpp"

namespace torquescope::testing {

inline std::vector<std::string> const& landscape_names() {
  static std::vector<std::string> const names{
      "sphere",         "ellipsoid", "rosenbrock",       "sharp ridge",       "rastrigin",
      "step ellipsoid", "gallagher", "different powers", "turned rosenbrock", "turned rastrigin"};
  return names;
}

class Landscape {
 public:
  Landscape(std::string name, std::size_t dimension, std::uint32_t instance)
      : name_(std::move(name)), n_(static_cast<Eigen::Index>(dimension)), centre_(n_), peaks_(n_, n_peaks) {
    RandomStream random({46, instance, RandomDomain::test}, 0, 0);
    Eigen::MatrixXd normal(n_, n_);
    for (double& x : normal.reshaped()) x = random.normal();
    turn_ = qr_factors(normal, Eigen::MatrixXd::Identity(n_, n_)).q_right.transpose();
    for (double& x : centre_) x = random.uniform(-4.0, 4.0);
    for (double& x : peaks_.reshaped()) x = random.uniform(-5.0, 5.0);
    // the first peak is the minimum
    peaks_.col(0).setZero();
  }

  double operator()(std::span<double const> at) const {
    Eigen::VectorXd const x = Eigen::Map<Eigen::VectorXd const>(at.data(), n_) - centre_;
    if (name_ == "sphere") return x.squaredNorm();
    if (name_ == "rosenbrock") return rosenbrock((x.array() + 1.0).matrix());
    if (name_ == "rastrigin") return bumpy(x);
    Eigen::VectorXd const z = turn_ * x;
    if (name_ == "turned rosenbrock") return rosenbrock((z.array() + 1.0).matrix());
    if (name_ == "turned rastrigin") return bumpy(z);
    if (name_ == "ellipsoid") return stretched(z, 1e6);
    if (name_ == "sharp ridge") return z[0] * z[0] + 100.0 * z.tail(n_ - 1).norm();
    if (name_ == "step ellipsoid") return stretched((z.array() + 0.5).floor().matrix(), 100.0);
    if (name_ == "gallagher") return gallagher(z);
    double sum = 0.0;
    for (Eigen::Index j = 0; j < n_; ++j) sum += std::pow(std::fabs(z[j]), 2.0 + 4.0 * share(j));
    return std::sqrt(sum);
  }

 private:
  static constexpr Eigen::Index n_peaks = 101;

  double share(Eigen::Index j) const { return static_cast<double>(j) / static_cast<double>(n_ - 1); }

  double stretched(Eigen::VectorXd const& z, double condition) const {
    double sum = 0.0;
    for (Eigen::Index j = 0; j < n_; ++j) sum += std::pow(condition, share(j)) * z[j] * z[j];
    return sum;
  }

  static double bumpy(Eigen::VectorXd const& z) {
    return (10.0 + z.array().square() - 10.0 * (2.0 * std::numbers::pi * z.array()).cos()).sum();
  }

  double rosenbrock(Eigen::VectorXd const& z) const {
    double sum = 0.0;
    for (Eigen::Index j = 0; j + 1 < n_; ++j)
      sum += 100.0 * std::pow(z[j] * z[j] - z[j + 1], 2) + std::pow(z[j] - 1.0, 2);
    return sum;
  }

  double gallagher(Eigen::VectorXd const& z) const {
    double most = std::exp(-0.5 * z.squaredNorm() / static_cast<double>(n_));
    for (Eigen::Index k = 1; k < n_peaks; ++k) {
      double const height = 0.11 + 0.8 * static_cast<double>(k - 1) / static_cast<double>(n_peaks - 2);
      most = std::max(most, height * std::exp(-0.5 * (z - peaks_.col(k)).squaredNorm() / static_cast<double>(n_)));
    }
    return 1.0 - most;
  }

  std::string name_;
  Eigen::Index n_;
  Eigen::MatrixXd turn_;
  Eigen::VectorXd centre_;
  Eigen::MatrixXd peaks_;
};

// evaluations until the target was reached; 0: not within so many
inline std::int64_t evaluations_to_target(Optimiser& search, Fitness const& fitness, double target, std::int64_t most) {
  while (search.progress().evaluations < most) {
    run_to_generation(search, fitness, search.progress().evaluations == 0 ? 0 : search.progress().generation + 1);
    if (search.progress().best_fitness <= target) return search.progress().evaluations;
  }
  return 0;
}

}  // namespace torquescope::testing
