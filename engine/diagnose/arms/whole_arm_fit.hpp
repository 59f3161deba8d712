#pragma once
// One effect of the whole arm beside its model: the instants between which it acts, its parameters, and what both leave
// on rows that were left out.
//
// Instants   each to the kept sample, within a stretch of where the scan found it: the largest fall of the energy
// Errors     of one standard deviation, stretches as clusters (Liang, Zeger 1986, doi:10.1093/biomet/73.1.13)
// Shapes     n rows, r parameters of the effect
// Threads    free functions

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "engine/diagnose/arms/whole_arm_scan.hpp"

namespace torquescope {

// of one recording; infinite where the effect acts from its beginning, to its end
struct ActingTime {
  std::size_t recording = 0;
  double from_s = -std::numeric_limits<double>::infinity(), until_s = std::numeric_limits<double>::infinity();

  bool holds(std::size_t of_recording, double time_s) const {
    return of_recording == recording && time_s >= from_s && time_s < until_s;
  }
};

struct WholeArmFit {
  std::optional<ActingTime> time{};    // none: everywhere
  Eigen::VectorXd values{}, errors{};  // r
  std::vector<bool> is_told{};         // r: false: the rows know it in combinations with others alone
  Eigen::MatrixXd directions{};        // n x rank: orthonormal, what its columns add to the basis
  double torque = 0.0;                 // energy beside the basis
};

// basis: n x k orthonormal; residual: n, what it leaves
WholeArmFit fit_whole_arm_effect(WholeArmRows const& rows, ScannedEffect const& found, Eigen::MatrixXd const& basis,
                                 Eigen::VectorXd const& residual);

// n: what is left of the signal on rows that were left out
Eigen::VectorXd left_out_of_stretches(WholeArmRows const& rows, Eigen::MatrixXd const& basis,
                                      Eigen::VectorXd const& signal);

}  // namespace torquescope
