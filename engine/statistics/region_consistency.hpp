#pragma once
// Does an effect help where it acts? A term that is there lowers the mismatch on the rows on which its own torque is
// large; one that fits by luck, or stands in for another, lowers it elsewhere.
//
// Region     the rows with the largest torque of the effect (less what the model explains already) that hold 90 % of
//            its energy: where it predicts to be seen
// Share      of the energy that the effect takes from the mismatch, how much it takes inside its region. An effect that
//            is there takes 90 % on average; another form of the same physics, less
// Asked for  70 %; less when noise alone takes less in one of twenty clean twins with that effect in them: a weak
//            effect is not refused for the noise it lies in
// Shapes     n rows, M twins
// Threads    free function
// Source     PHYSICS.md section 2 step 7

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
