#pragma once
// The slope of a fit by simulation at one point: normal equations of central differences, each channel by its own
// noise, and the intervals that follow from them.
//
// Equation   weight of channel c: n_eff,c / S_c; curvature = sum J' w J, descent = sum J' w r, r: measured - simulated
// Intervals  95 %, Newey-West on the scores of all samples (problem/hac.hpp); of what is at a bound, or moves nothing,
//            there are none
// Units      SI
// Threads    free functions; simulations are spread over `threads`
// Source     Newey, West 1987, doi:10.2307/1913610

#include <Eigen/Core>
#include <vector>

#include "engine/simulate/rollout/fit_unknowns.hpp"

namespace torquescope {

struct FitSlope {
  Eigen::MatrixXd curvature;
  Eigen::VectorXd descent;
  std::vector<Eigen::MatrixXd> jacobian;  // of each track and channel that counts: d simulated, weighed
  std::vector<Eigen::VectorXd> residual;  // weighed
};

// width: of the differences, as a share of a parameter's scale
FitSlope slope_at(FitUnknowns const& unknowns, FitPoint const& at, ChannelNumbers const& effective, double width,
                  int threads);

// of the model's parameters; NaN where there is none
struct FitIntervals {
  Eigen::VectorXd errors, lower, upper;
};
FitIntervals no_intervals(Eigen::Index parameters);
FitIntervals intervals_of(FitUnknowns const& unknowns, FitPoint const& at, FitSlope const& slope);

// of the first point, over all tracks
ChannelNumbers sums_of(std::vector<TrackResiduals> const& residuals, Eigen::Index point);

}  // namespace torquescope
