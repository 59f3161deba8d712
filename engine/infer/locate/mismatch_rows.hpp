#pragma once
// A recording and replicates of its model on the same rows: what maps and curves are drawn from.
//
// Residual   of the model on the rows of a decision (decision/strip.hpp)
// Shapes     n rows in time order, M replicates: 8 n M bytes
// Units      SI
// Threads    plain record

#include <Eigen/Core>
#include <vector>

#include "engine/infer/locate/motion_axes.hpp"

namespace torquescope {

// axes: of the motion, per row
struct MismatchRows : MotionAxes {
  double rate_hz = 0.0;                   // of the kept samples
  std::vector<Eigen::Index> kept_rows{};  // of each row: index among the kept samples
  Eigen::VectorXd torque{};               // of the recording, filtered
  Eigen::VectorXd residual{};             // of the recording
  Eigen::VectorXd replicate_mean{};       // mean residual of the replicates
  Eigen::MatrixXd replicates{};           // n x M: residual of each replicate

  Eigen::Index size() const { return residual.size(); }
  Eigen::Index n_replicates() const { return replicates.cols(); }
};

}  // namespace torquescope
