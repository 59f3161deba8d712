#pragma once
// The samples at which a joint surely moves one way: everything but reversals and what the regression filter smears.
//
// Equation   still_k: |dq_k| < 0.005 v, or the sign of dq differs from that of sample k-1; v: the peak, but no
//            more than three times the speed that a twentieth exceeds: one fast homing move is no scale
//            dropped: every sample within 1.6 / cutoff_hz of a still one (cutoff_hz 0: nothing is widened)
// Reversals  kept where a job weighs them: then only rests are dropped
// Use        on the whole record before its edges are cut, on recording and replicates, each from its filtered velocity
// Shapes     dq: n samples at the full rate; result: n, true where the sample is kept
// Units      rad/s or m/s; Hz
// Threads    free function
// Source     METHOD.md, A first look

#include <Eigen/Core>
#include <vector>

namespace torquescope {

// samples that the regression filter smears a still one over
Eigen::Index mask_reach(double rate_hz, double cutoff_hz);

std::vector<bool> moving_samples(Eigen::VectorXd const& dq, double rate_hz, double cutoff_hz);

}  // namespace torquescope
