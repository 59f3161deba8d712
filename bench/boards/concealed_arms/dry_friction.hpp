#pragma once
// Speeds after a step against dry friction: A v + level * Sgn(v) contains r.
//
// Shapes     A n x n symmetric positive definite; r, level >= 0 and v of n
// Accuracy   exact once the signs are right, which they mostly are at the first try; else projected Gauss-Seidel
// Source     Stewart, Trinkle 1996, doi 10.1002/(SICI)1097-0207(19960815)39:15<2673::AID-NME972>3.0.CO;2-I

#include <Eigen/Core>

namespace concealed_arms {

Eigen::VectorXd speeds_against_dry_friction(Eigen::MatrixXd const& a, Eigen::VectorXd const& r,
                                            Eigen::VectorXd const& level, Eigen::VectorXd const& before);

}  // namespace concealed_arms
