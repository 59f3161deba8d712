#pragma once
// Instants of a joint side by side, one array per quantity, and the functions that laws of effects are written with.
//
// Shapes     n instants, n <= states_at_once: a block of a recording, the lanes of a group of twins, or one instant
// Bits       of a law over them: the same for any n and any place (kernels/elementary.hpp), so that simulation and
//            columns agree to the last digit
// Threads    views and free functions; do not allocate

#include <Eigen/Core>

#include "engine/effects/joint_scales.hpp"
#include "kernels/elementary.hpp"

namespace torquescope {

// a column of a block and a temporary stay in the L1 cache
inline constexpr Eigen::Index states_at_once = 256;

struct JointStates {
  using Quantity = Eigen::Map<Eigen::ArrayXd const>;
  Quantity time_s, q, dq, ddq;
  Quantity load_torque, motor_torque;  // as in JointState

  Eigen::Index size() const { return q.size(); }
};

// a quantity a law needs on its way
using Scratch = Eigen::Array<double, Eigen::Dynamic, 1, 0, states_at_once, 1>;
// n x n_linear(): torque per unit of each linear parameter
using LawColumns = Eigen::Ref<Eigen::ArrayXXd>;

// -1, 0, 1; sign(0) = 0
inline auto sign(JointStates::Quantity const& velocity) {
  return velocity.unaryExpr([](double v) { return static_cast<double>((v > 0.0) - (v < 0.0)); });
}

// JointScales::friction_sign of each
inline auto friction_sign(JointStates::Quantity const& velocity, JointScales const& scales) {
  double const forward = scales.friction_sign(1.0), backward = scales.friction_sign(-1.0);
  return velocity.unaryExpr([=](double v) { return v > 0.0 ? forward : v < 0.0 ? backward : 0.0; });
}

// 1 from `start` on, 0 before
inline auto is_after(JointStates::Quantity const& time_s, double start) { return (time_s >= start).cast<double>(); }

using LawColumn = Eigen::Ref<Eigen::ArrayXd>;

// x = e^x
inline void exponential(LawColumn x) { kernels::exponential(x.data(), static_cast<std::size_t>(x.size()), x.data()); }

// x = |x|^exponent
inline void power_of_size(LawColumn x, double exponent) {
  kernels::power_of_size(x.data(), exponent, static_cast<std::size_t>(x.size()), x.data());
}

// cos(factor x), sin(factor x)
inline void cosine_sine(double factor, Eigen::Ref<Eigen::ArrayXd const> x, LawColumn cosine, LawColumn sine) {
  kernels::cosine_sine_of_multiple(factor, x.data(), static_cast<std::size_t>(x.size()), cosine.data(), sine.data());
}

}  // namespace torquescope
