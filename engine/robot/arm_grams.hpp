#pragma once
// Products of every joint's columns and torque: all that least squares asks of a recording of an arm, in one sweep.
//
// Equation   products = [X tau]' W [X tau], X the rows of joint j (arm_rows.hpp), W its weights (root_weight squared)
// Use        weights per joint, prior rows, leaving joints out or records: sums of these, without a second sweep
// Bits       the same for any number of threads and any instruction set (kernels/joint_grams.hpp)
// Memory     no Phi: half a megabyte a thread, and at most 128 partial sums of all products
// Threads    joint_grams() starts its own

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/robot/arm_rows.hpp"

namespace torquescope {

struct JointGram {
  Eigen::MatrixXd products;  // (columns + 1) x (columns + 1), symmetric, the torque last
  Eigen::Index count = 0;    // rows whose weight is not 0
};

// one a joint. samples: one a joint, of n >= 0 samples
std::vector<JointGram> joint_grams(ArmRows const& rows, std::span<JointSamples const> samples, int threads);

}  // namespace torquescope
