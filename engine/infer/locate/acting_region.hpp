#pragma once
// Where on an axis an effect acts: the cells with its largest torque, as one interval or as two.
//
// Cells      up to 400, equally populated; acting: the strongest ones that together hold 80 % of its energy
// Equation   the interval, or the two, with the largest (acting samples inside) / (samples inside or acting) (Jaccard).
//            Two are given when they match by a quarter better
// Units      of the axis
// Threads    free function
// Source     METHOD.md, The mismatch map; ratio maximised after Dinkelbach 1967, doi:10.1287/mnsc.13.7.492

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
