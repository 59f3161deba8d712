#pragma once
// The samples at which a joint surely moves one way: everything but reversals and what the regression filter smears of
// them.
//
// Equation   still_k: |dq_k| < 0.005 max|dq|, or the sign of dq differs from that of sample k-1;
//            dropped: every sample within 1.6 / cutoff_hz of a still one
// Reversals  kept where friction that builds up after them is asked for (friction_buildup.hpp): there only rests are
//            dropped, for what friction holds at rest no law of the motion says
// Why        the filtered velocity misplaces the sign of friction by a few samples, and no law of sticking is known
//            well enough to be simulated there: with these rows nothing was calibrated, without them everything else
//            shows up to ten times clearer, whatever the true law of sticking is
// Use        on the whole record before its edges are cut (a reversal just outside reaches in), on data and twins
//            alike, each from its own filtered velocity
// Shapes     dq: n samples at the full rate; result: n, true where the sample is kept
// Units      rad/s or m/s; Hz; cutoff_hz is that of the filter the rows go through, 0: none, nothing is widened
// Threads    free function
// Source     LESSONS item 3 of our own prototype (40 clean sets)

#include <Eigen/Core>
#include <vector>

namespace torquescope {

std::vector<bool> moving_samples(Eigen::VectorXd const& dq, double rate_hz, double cutoff_hz);

// dropped: every stretch slower than 0.005 max|dq| that lasts longer than 1.6 / cutoff_hz, and as much before and after
// it
std::vector<bool> samples_without_rest(Eigen::VectorXd const& dq, double rate_hz, double cutoff_hz);

// such a stretch itself, and nothing round it
std::vector<bool> resting_samples(Eigen::VectorXd const& dq, double rate_hz, double cutoff_hz);

}  // namespace torquescope
