#pragma once
// A motion with exact derivatives (three sines, many reversals), and a joint whose baseline is known.

#include <cmath>

#include "engine/effects/fitted_baseline.hpp"

namespace torquescope::test {

inline JointState smooth_state(double time_s) {
  constexpr double amplitude[] = {0.9, 0.35, 0.05}, omega[] = {1.7, 4.1, 13.0}, phase[] = {0.3, 1.1, 2.0};
  JointState state{time_s};
  for (int k = 0; k < 3; ++k) {
    double const angle = omega[k] * time_s + phase[k];
    state.q += amplitude[k] * std::sin(angle);
    state.dq += amplitude[k] * omega[k] * std::cos(angle);
    state.ddq -= amplitude[k] * omega[k] * omega[k] * std::sin(angle);
  }
  return state;
}

// rows of a motion from states at even steps
template <class StateAt>
Motion motion_of(StateAt state_at, Eigen::Index n, double rate_hz, double start_s = 0.0) {
  Motion motion;
  motion.rate_hz = rate_hz;
  for (auto* channel : {&motion.time_s, &motion.q, &motion.dq, &motion.ddq, &motion.torque}) channel->setZero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    JointState const state = state_at(static_cast<double>(i) / rate_hz);
    motion.time_s[i] = start_s + static_cast<double>(i) / rate_hz;
    motion.q[i] = state.q;
    motion.dq[i] = state.dq;
    motion.ddq[i] = state.ddq;
  }
  return motion;
}

// the joint of the tests: Coulomb levels that differ, gravity of an angle
struct KnownJoint {
  JointKind kind = JointKind::revolute;
  Regressor regressor = kind == JointKind::revolute
                            ? Regressor({"inertia", "viscous", "coulomb_positive", "coulomb_negative", "gravity"}, kind)
                            : Regressor({"inertia", "viscous", "coulomb_positive", "coulomb_negative"}, kind);
  std::vector<double> parameters = kind == JointKind::revolute ? std::vector<double>{0.05, 0.2, 0.3, -0.5, 1.2, -0.4}
                                                               : std::vector<double>{0.05, 0.2, 0.3, -0.5};

  // fills the torque of the motion, too
  FittedBaseline baseline(Motion& motion, double cutoff_hz = 40.0, double encoder_step = 1e-4) const {
    motion.torque = regressor.columns(motion) *
                    Eigen::Map<Eigen::VectorXd const>(parameters.data(), static_cast<Eigen::Index>(parameters.size()));
    return fitted_baseline(regressor, parameters, motion, cutoff_hz, encoder_step);
  }
};

// in the middle of the bounds, on the scale the search uses
inline std::vector<double> shape_between(Effect const& effect, JointScales const& scales, double share = 0.5) {
  std::vector<double> shape;
  for (auto const& range : effect.shape_bounds(scales))
    shape.push_back(range.spacing == Spacing::logarithmic ? range.lower * std::pow(range.upper / range.lower, share)
                                                          : range.lower + share * (range.upper - range.lower));
  return shape;
}

inline Eigen::MatrixXd columns_of(Effect const& effect, EffectInput const& input, std::vector<double> const& shape) {
  Eigen::MatrixXd phi(input.size(), static_cast<Eigen::Index>(effect.n_linear()));
  effect.columns(input, shape, phi);
  return phi;
}

// linear ones 1, 1.5, 2 ... then the shape
inline std::vector<double> parameters_with(Effect const& effect, std::vector<double> const& shape) {
  std::vector<double> parameters;
  for (std::size_t k = 0; k < effect.n_linear(); ++k) parameters.push_back(1.0 + 0.5 * static_cast<double>(k));
  parameters.insert(parameters.end(), shape.begin(), shape.end());
  return parameters;
}

inline Eigen::VectorXd linear_part(Effect const& effect, std::vector<double> const& parameters) {
  return Eigen::Map<Eigen::VectorXd const>(parameters.data(), static_cast<Eigen::Index>(effect.n_linear()));
}

}  // namespace torquescope::test
