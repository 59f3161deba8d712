#pragma once
// The seed's joint on a smooth multisine, without filter: tau = phi * parameters + noise, rows as an estimator gets
// them.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/random_stream.hpp"
#include "engine/fit/problem/estimator.hpp"

namespace torquescope::test {

inline std::vector<std::string> const seed_terms{"inertia", "viscous", "coulomb_positive", "coulomb_negative"};
inline Eigen::Vector4d const seed_ols{0.0036, 0.0164, 0.0089, -0.2582};

// `seconds` of three incommensurate sines at 100 Hz, speed up to about 3 rad/s
inline Motion multisine(double seconds) {
  auto const n = static_cast<Eigen::Index>(std::lround(seconds * 100.0));
  Motion motion;
  motion.rate_hz = 100.0;
  motion.time_s.resize(n);
  motion.q.setZero(n);
  motion.dq.setZero(n);
  motion.ddq.setZero(n);
  double const amplitude[] = {0.9, 0.3, 0.08}, frequency_hz[] = {0.31, 0.83, 2.1}, phase[] = {0.3, 1.1, 2.2};
  for (Eigen::Index i = 0; i < n; ++i) {
    motion.time_s[i] = 0.01 * static_cast<double>(i);
    for (int k = 0; k < 3; ++k) {
      double const w = 2.0 * std::numbers::pi * frequency_hz[k], x = w * motion.time_s[i] + phase[k];
      motion.q[i] += amplitude[k] * std::sin(x);
      motion.dq[i] += amplitude[k] * w * std::cos(x);
      motion.ddq[i] -= amplitude[k] * w * w * std::sin(x);
    }
  }
  motion.torque = Eigen::VectorXd::Zero(n);
  return motion;
}

inline RegressionData regression_data(Motion const& motion, Regressor const& regressor, Eigen::VectorXd tau) {
  RegressionData data;
  data.phi = regressor.columns(motion);
  data.tau = std::move(tau);
  data.columns = regressor.column_owners();
  data.time_s = motion.time_s;
  data.q = motion.q;
  data.dq = motion.dq;
  data.ddq = motion.ddq;
  data.first_row = {0, motion.q.size()};
  data.recording_names = {"multisine"};
  data.rate_hz = {motion.rate_hz};
  data.kept_rate_hz = motion.rate_hz;
  return data;
}

inline Eigen::VectorXd white_noise(Eigen::Index n, std::uint32_t run, double deviation) {
  RandomStream random({11, run, RandomDomain::test}, 0, 0);
  Eigen::VectorXd noise(n);
  for (auto& e : noise) e = deviation * random.normal();
  return noise;
}

// stationary e_t = rho e_{t-1} + white, of the given deviation
inline Eigen::VectorXd autoregressive_noise(Eigen::Index n, std::uint32_t run, double deviation, double rho) {
  Eigen::VectorXd noise = white_noise(n, run, deviation);
  for (Eigen::Index i = 1; i < n; ++i) noise[i] = rho * noise[i - 1] + std::sqrt(1.0 - rho * rho) * noise[i];
  return noise;
}

// the seed's joint with this noise on top
inline RegressionData seed_data(double seconds, Eigen::VectorXd const& noise) {
  Regressor const regressor(seed_terms, JointKind::revolute);
  auto const motion = multisine(seconds);
  auto data = regression_data(motion, regressor, noise);
  data.tau += data.phi * seed_ols;
  return data;
}

inline RegressionData seed_data(double seconds, double deviation = 0.0, std::uint32_t run = 0) {
  return seed_data(seconds, white_noise(std::lround(seconds * 100.0), run, deviation));
}

inline LeastSquaresFit fit(std::string const& estimator, RegressionData const& data,
                           std::vector<Setting> const& settings = {}) {
  std::vector<Problem> problems;
  auto const estimate = find_estimator(estimator)->prepare({"estimator", {}, settings}, {}, problems);
  if (!problems.empty()) throw Error(problems);
  return estimate(data);
}

// relative to the size of each: parameters differ by orders of magnitude
inline double largest_relative_difference(Eigen::VectorXd const& a, Eigen::VectorXd const& b) {
  return ((a - b).array() / b.array()).abs().maxCoeff();
}

}  // namespace torquescope::test
