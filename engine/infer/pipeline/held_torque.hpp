#pragma once
// What a torque that holds from its sample to the next does to the joint at the instant of a sample, and the inverse.
//
// Why        at the instant of a sample the joint has been moved by the torque of the row before, so a controller's
//            torque is half a sample early beside its motion (METHOD.md, Rows of a recording). Replicates hold theirs,
//            too
// Equation   acting: mean over the sample before, of the cubic through the rows around it, (13 (u[k-1] + u[k]) - u[k-2]
//            - u[k+1]) / 24. to hold: value in the middle of the sample that begins, less what the mean adds to it, (7
//            (u[k] + u[k+1]) - u[k-1] - u[k+2]) / 12. One after the other gives back cubics
// Rows       at the ends that the equations do not reach: as read
// Units      as the torque
// Threads    free functions

#include <Eigen/Core>

namespace torquescope {

// [n], any length
Eigen::VectorXd acting_torque(Eigen::Ref<Eigen::VectorXd const> const& held);
Eigen::VectorXd torque_to_hold(Eigen::Ref<Eigen::VectorXd const> const& acting);

}  // namespace torquescope
