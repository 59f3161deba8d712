#pragma once
// Where on an axis an effect acts: the cells with its largest torque, said as one interval or as two.
//
// Cells      up to 400, equally populated
// Acting     the cells with most energy that together hold 80 % of it
// One, two   the interval, or the two, that match the acting cells best: most samples in both over samples in either
//            (Jaccard). A law that acts at high speed in both directions needs two; they are given when they match by a
//            quarter better, for two are harder to say than one
// Units      of the axis
// Threads    free function
// Source     PHYSICS.md section 4 (region: samples holding 80 % of the energy); ratio maximised after Dinkelbach 1967

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace torquescope {

struct ActingRegion {
  std::pair<double, double> interval{};                // the best single one
  std::vector<std::pair<double, double>> intervals{};  // one or two, ascending
};

// at: place of every sample, finite; energy: of the effect there, not negative.  Requires  at least one sample
ActingRegion acting_region(Eigen::VectorXd const& at, Eigen::VectorXd const& energy);

}  // namespace torquescope
