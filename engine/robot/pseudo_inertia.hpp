#pragma once
// The ten numbers of a link as a symmetric 4 x 4 matrix, which is positive definite exactly when a body of positive
// density has them.
//
// Equation   P = [S h; h' m], S = trace(I) / 2 - I: the second moments of mass about the frame's origin
//            divergence(P, Q) = log det Q - log det P + trace(Q^-1 P) - 4 >= 0, and 0 only where P = Q
// Units      kg m^2, kg m, kg
// Threads    pure functions
// Source     Wensing, Kim, Slotine 2018, doi:10.1109/LRA.2017.2729659 (the matrix); Lee, Wensing, Park 2020,
//            doi:10.1109/TRO.2019.2926491 (the divergence as a distance from a prior, whatever frame or unit)

#include <Eigen/Core>

#include "engine/robot/link_inertia.hpp"

namespace torquescope {

using PseudoInertia = Eigen::Matrix4d;

PseudoInertia pseudo_inertia(LinkVector const& link);
LinkVector link_vector(PseudoInertia const& pseudo);

bool is_positive_definite(PseudoInertia const& pseudo);

// Requires   both positive definite
double divergence(PseudoInertia const& pseudo, PseudoInertia const& prior);

// lower, pseudo = factor * factor'. Requires   positive definite
PseudoInertia cholesky_factor(PseudoInertia const& pseudo);
PseudoInertia inverse(PseudoInertia const& pseudo);

}  // namespace torquescope
