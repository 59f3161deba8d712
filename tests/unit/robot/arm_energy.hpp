#pragma once
// Kinetic and potential energy of an arm, its rotors included.
//
// Equation   T = sum of (m v.v / 2 + v.(w x h) + w.I w / 2) + sum of drive_i dq_i^2 / 2;  V = - gravity . sum of (m p +
//            R h)
// Shapes     q, dq: N; parameters: 10 N or 11 N, standard, or base values in their columns
// Units      J; V is 0 where all of the arm is at the base's origin
// Threads    pure functions

#include <Eigen/Core>

#include "engine/robot/inverse_dynamics.hpp"

namespace torquescope::test {

double kinetic_energy(SerialChain const& chain, JointVector const& parameters, JointVector const& q,
                      JointVector const& dq);
double potential_energy(SerialChain const& chain, JointVector const& parameters, JointVector const& q);

}  // namespace torquescope::test
