#pragma once
// Does an effect help where it acts? A right law lowers the mismatch where its own torque is large.
//
// Region     the rows with the largest torque of the effect (beside the model) that hold 90 % of its energy
// Share      of the energy that the effect takes from the mismatch, how much it takes inside its region
// Asked for  70 %; less when noise alone takes less in one of twenty replicates with that effect in them
// Shapes     n rows, M replicates
// Threads    free function
// Source     METHOD.md, Conditions of acceptance

#include <Eigen/Core>

namespace torquescope {

inline constexpr double region_energy = 0.9;

struct RegionConsistency {
  double share = 0.0;
  double asked_for = 0.0;

  bool holds() const { return share >= asked_for; }
};

// torque: n, of the effect, fitted to the mismatch; mismatch: n; both without what the model's columns explain
// twins: n x M, residuals of clean twins, their mean taken off; M >= 1.  Requires  torque is not zero everywhere
RegionConsistency region_consistency(Eigen::VectorXd const& torque, Eigen::VectorXd const& mismatch,
                                     Eigen::MatrixXd const& twins);

}  // namespace torquescope
