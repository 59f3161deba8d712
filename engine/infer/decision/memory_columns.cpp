#include "engine/infer/decision/memory_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace torquescope {
namespace {

constexpr double damping = 0.2, periods_at_least = 10.0, frequency_ratio = std::numbers::sqrt2;

// position and speed of the load, in units of the acceleration; at rest before the first sample
Eigen::MatrixXd driven_load(Eigen::VectorXd const& acceleration, double omega, double interval_s) {
  double const free = omega * std::sqrt(1.0 - damping * damping), decay = std::exp(-damping * omega * interval_s);
  double const sine = std::sin(free * interval_s) * decay / free, cosine = std::cos(free * interval_s) * decay;
  // exact from sample to sample, the acceleration being held
  Eigen::Matrix2d step;
  step << cosine + damping * omega * sine, sine, -omega * omega * sine, cosine - damping * omega * sine;
  Eigen::MatrixXd load(acceleration.size(), 2);
  Eigen::Vector2d state = Eigen::Vector2d::Zero();
  for (Eigen::Index k = 0; k < acceleration.size(); ++k) {
    load.row(k) << state[0] * omega * omega, state[1] * omega;
    Eigen::Vector2d const middle{acceleration[k] / (omega * omega), 0.0};
    state = middle + step * (state - middle);
  }
  return load;
}

Eigen::VectorXd followed(Eigen::ArrayXd const& signal, double omega, double interval_s) {
  double const keep = std::exp(-omega * interval_s);
  Eigen::VectorXd slow(signal.size());
  double state = signal[0];
  for (Eigen::Index k = 0; k < signal.size(); ++k) slow[k] = state = keep * state + (1.0 - keep) * signal[k];
  return slow;
}

}  // namespace

std::vector<double> memory_frequencies(std::span<Strip const> strips) {
  double shortest_s = std::numeric_limits<double>::infinity(), cutoff_hz = shortest_s;
  for (auto const& strip : strips) {
    shortest_s = std::min(shortest_s, strip.duration_s());
    cutoff_hz = std::min(cutoff_hz, strip.filters->cutoff_hz);
  }
  std::vector<double> frequencies;
  for (double f = periods_at_least / shortest_s; f <= 0.5 * cutoff_hz; f *= frequency_ratio) frequencies.push_back(f);
  return frequencies;
}

Eigen::MatrixXd memory_columns(Strip const& strip, Eigen::VectorXd const& torque, double frequency_hz) {
  double const omega = 2.0 * std::numbers::pi * frequency_hz, interval_s = 1.0 / strip.motion.rate_hz;
  Eigen::VectorXd const mean_speed = followed(strip.motion.dq.array().abs(), omega, interval_s);
  Eigen::MatrixXd signals(strip.size(), 4);
  signals << driven_load(strip.motion.ddq, omega, interval_s), mean_speed.cwiseProduct(torque),
      mean_speed.cwiseProduct(strip.direction);
  return on_rows(strip, signals);
}

}  // namespace torquescope
