#pragma once
// What the samples of one signal show by themselves: its quantisation step, its time at a limit, its white noise.
//
// Shapes     any length; too few samples give 0
// Threads    functions of their arguments

#include <Eigen/Core>
#include <span>

namespace torquescope {

// smallest step of a quantised signal; 0 when its differences are no multiples of one step
double quantisation_step(std::span<double const> values);

// share of samples that lie exactly at the largest or smallest value, at least three in a row, when that value is met
// more often than the values beside it (a quantised signal turning round is not at a limit)
double limit_share(std::span<double const> values);

// rows for which every value is held before the next comes, 1 where values come as they like: the step of an even grid
// on which nine of ten changes lie. A coarse signal also repeats itself, but changes on any row
Eigen::Index held_rows(std::span<double const> values);

// standard deviation of white noise: median absolute second difference. An upper bound while the signal itself bends
double white_noise(Eigen::Ref<Eigen::VectorXd const> const& signal);

}  // namespace torquescope
