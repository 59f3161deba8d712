#pragma once
// The commanded motion of an arm: sums of sines over ten seconds, or moves from pose to pose with rests.
//
// Shapes     matrices of joints x control ticks (1 kHz): position [rad], speed, acceleration
// Limits     every joint stays within its range, speed and acceleration of arm_numbers.hpp
// Random     the same seed is the same motion

#include <Eigen/Core>
#include <cstdint>

#include "concealed_arms/arm_numbers.hpp"

namespace concealed_arms {

inline constexpr double control_s = 1e-3;
inline constexpr int log_every = 2;  // control ticks: 500 rows a second
inline constexpr double recorded_s = 20.0;

enum class MotionKind { sines, moves };

struct ArmMotion {
  Eigen::MatrixXd q, v, a;
  Eigen::VectorXd travel() const { return q.rowwise().maxCoeff() - q.rowwise().minCoeff(); }
  Eigen::VectorXd fastest() const { return v.cwiseAbs().rowwise().maxCoeff(); }
};

// `stream` tells the training motion from the validation one
ArmMotion drawn_motion(MotionKind kind, Arm const& arm, std::uint64_t seed, std::string const& stream);

}  // namespace concealed_arms
