#pragma once
// One instant of a joint, instants side by side, one array per quantity, and the functions that effects are
// written with.
//
// Shapes     n instants, n <= states_at_once: a block of a recording, the lanes of a group of replicates, or one
//            instant
// Bits       of an effect over them: the same for any n and any place (kernels/elementary.hpp), so that simulation and
//            columns agree to the last digit
// Threads    views and free functions; do not allocate

#include <Eigen/Core>

#include "engine/effects/joint_scales.hpp"
#include "kernels/elementary.hpp"

namespace torquescope {

// a column of a block and a temporary stay in the L1 cache
inline constexpr Eigen::Index states_at_once = 256;

// one instant of a joint
struct JointState {
  double time_s = 0.0, q = 0.0, dq = 0.0, ddq = 0.0;
  double load_torque = 0.0;   // of the baseline: gravity, springs and inertia
  double motor_torque = 0.0;  // what the motor gives; for columns, what the whole baseline says it gives
};

struct JointStates {
  using Quantity = Eigen::Map<Eigen::ArrayXd const>;
  Quantity time_s, q, dq, ddq;
  Quantity load_torque, motor_torque;  // as in JointState

  Eigen::Index size() const { return q.size(); }
  JointState state(std::size_t i) const {
    auto const at = static_cast<Eigen::Index>(i);
    return {time_s[at], q[at], dq[at], ddq[at], load_torque[at], motor_torque[at]};
  }
  // a view of one of these, which outlive it
  JointStates only(Eigen::Index i) const {
    auto const one = [i](Quantity const& of) { return Quantity(of.data() + i, 1); };
    return {one(time_s), one(q), one(dq), one(ddq), one(load_torque), one(motor_torque)};
  }
  // a view of one instant, which outlives it
  static JointStates of(JointState const& one) {
    auto const alone = [](double const& value) { return Quantity(&value, 1); };
    return {alone(one.time_s), alone(one.q),           alone(one.dq),
            alone(one.ddq),    alone(one.load_torque), alone(one.motor_torque)};
  }
};

// a quantity an effect needs on its way
using Scratch = Eigen::Array<double, Eigen::Dynamic, 1, 0, states_at_once, 1>;
// of instants that have their own: [instant][parameter]
using ParametersOfEach = Eigen::Ref<Eigen::ArrayXXd const>;
// one of them, of each instant
using NumberOfEach = Eigen::Ref<Eigen::ArrayXd const>;
// n x n_linear(): torque per unit of each linear parameter
using EffectColumns = Eigen::Ref<Eigen::ArrayXXd>;

// -1, 0, 1; sign(0) = 0
inline auto sign(JointStates::Quantity const& velocity) {
  return velocity.unaryExpr([](double v) { return static_cast<double>((v > 0.0) - (v < 0.0)); });
}

inline auto friction_sign(JointStates::Quantity const& velocity, JointScales const& scales) {
  return velocity.unaryExpr(scales.friction_sign());
}

// 1 from `start` on, 0 before
inline auto is_after(JointStates::Quantity const& time_s, double start) { return (time_s >= start).cast<double>(); }

using EffectColumn = Eigen::Ref<Eigen::ArrayXd>;

// x = e^x
inline void exponential(EffectColumn x) {
  kernels::exponential(x.data(), static_cast<std::size_t>(x.size()), x.data());
}

// x = ln x
inline void logarithm(EffectColumn x) { kernels::logarithm(x.data(), static_cast<std::size_t>(x.size()), x.data()); }

// x = |x|^exponent
inline void power_of_size(EffectColumn x, double exponent) {
  kernels::power_of_size(x.data(), exponent, static_cast<std::size_t>(x.size()), x.data());
}
inline void power_of_size(EffectColumn x, NumberOfEach const& exponents) {
  kernels::power_of_size(x.data(), exponents.data(), static_cast<std::size_t>(x.size()), x.data());
}

// cos(factor x), sin(factor x)
inline void cosine_sine(double factor, Eigen::Ref<Eigen::ArrayXd const> const& x, EffectColumn cosine,
                        EffectColumn sine) {
  kernels::cosine_sine_of_multiple(factor, x.data(), static_cast<std::size_t>(x.size()), cosine.data(), sine.data());
}
inline void cosine_sine(NumberOfEach const& factors, Eigen::Ref<Eigen::ArrayXd const> const& x, EffectColumn cosine,
                        EffectColumn sine) {
  kernels::cosine_sine_of_multiple(factors.data(), x.data(), static_cast<std::size_t>(x.size()), cosine.data(),
                                   sine.data());
}

}  // namespace torquescope
