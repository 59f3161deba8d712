#pragma once
// A torque column whose zero steps once, or drifts in proportion to time, whatever the joint does.
//
// Equation   column = torque of the motion + c [t >= t_c], or + c (t - middle) / duration
// Told       it explains a quarter of what the motion leaves, beyond chance (of the scan over t_c); nearly all that any
//            slow change of the zero would; and friction, weight, damping or inertia that change with it in time
//            explain next to nothing beside it, as it explains much beside them
// Units      N m or N; s
// Threads    pure function

#include <optional>

#include "engine/fit/problem/torque_beside_motion.hpp"

namespace torquescope {

enum class ZeroChange { step, drift };

struct TorqueZero {
  ZeroChange change = ZeroChange::step;
  double size = 0.0;    // of the step, or from the first sample to the last
  double time_s = 0.0;  // of the step, as in the recording
  Eigen::Index sample = 0;
  double explained = 0.0;  // share of the energy that the motion leaves
};

// time_s, torque: [n] as recorded
std::optional<TorqueZero> torque_zero(TorqueBesideMotion const& beside, Eigen::VectorXd const& time_s,
                                      Eigen::VectorXd const& torque);

// [n] what the zero is off by: no mean of a drift
Eigen::VectorXd zero_error(TorqueZero const& zero, Eigen::VectorXd const& time_s);

}  // namespace torquescope
