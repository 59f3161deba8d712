#pragma once
// How well the parameters of an arm could be told from a motion.
//
// Equation   G = sum over joints of Y_j' Y_j / s_j^2: Y_j the columns of joint j's row, s_j the noise of its torque;
//            condition of Y with columns of length one; log det G per parameter; the smallest principal angle between
//            two sets of columns, once all others are projected off both
// Shapes     R parameters; columns of joint j: n x own[j].size()
// Threads    free function
// Source     Gautier and Khalil 1992, doi:10.1177/027836499201100408; Swevers et al. 1997, doi:10.1109/70.631234;
//            angles between subspaces: Bjorck and Golub 1973, doi:10.1090/S0025-5718-1973-0348991-3

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "engine/fit/excite/fourier_motion.hpp"

namespace torquescope {

// the linear model whose parameters are wanted, whatever they are
struct RowModel {
  Eigen::Index size = 0;
  std::vector<std::vector<Eigen::Index>> own{};  // parameters of each joint's row
  std::function<std::vector<Eigen::MatrixXd>(MotionSamples const&)> rows{};
  Eigen::VectorXd noise{};  // [N] of each joint's torque; only ratios matter to a motion
  // two sets of parameters, or none: whether one can be told from the other
  std::vector<Eigen::Index> one{}, other{};
};

struct MotionQuality {
  double condition = 0.0;        // infinite where a parameter moves nothing
  double log_determinant = 0.0;  // per parameter; -infinity likewise
  double angle = 0.0;            // rad, between one and other; 0 where some columns are sums of others
};

MotionQuality motion_quality(RowModel const& model, MotionSamples const& samples);

}  // namespace torquescope
