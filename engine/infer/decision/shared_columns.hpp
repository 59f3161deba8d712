#pragma once
// Columns that the joints of an arm share (masses of its links) beside each joint's own: what the rows of some joints
// tell of the shared parameters, and what is left for the own rows of one joint to tell.
//
// Equation   information of a joint: Y' (I - P) Y / v, its right side Y' (I - P) tau / v; Y: shared columns, P: onto
//            its own columns, v: squares that are left of the joint, over the number of independent ones
// Own share  of a direction of the parameters: the joint's own information over that of all. Directions with more than
//            half are free at that joint; along the others the parameters are as the other joints have them
// Dependent  directions that no joint tells have no information: they are neither free nor known, and zero
// Shapes     n rows, R shared parameters, k free directions
// Threads    pure functions
// Source     Frisch, Waugh 1933, doi:10.2307/1907330; Gautier, Khalil 1990, doi:10.1109/70.56655

#include <Eigen/Core>
#include <vector>

namespace torquescope {

// rows of one joint: what it shares, what is its own
struct SharedRows {
  Eigen::MatrixXd shared{}, own{};
  Eigen::VectorXd torque{};
};

struct SharedInformation {
  Eigen::MatrixXd gram{};   // R x R
  Eigen::VectorXd right{};  // R
  static SharedInformation none(Eigen::Index parameters);
  void add(SharedInformation const& other);
};

// v of a joint by what the rows leave of a fit of their own
double independent_variance(SharedRows const& rows);
SharedInformation information_of(SharedRows const& rows, double variance);
// the shortest solution of columns of equal length
Eigen::VectorXd shared_parameters(SharedInformation const& information);

struct SharedPart {
  Eigen::VectorXd known{};       // R: by the other joints
  Eigen::MatrixXd directions{};  // R x k
};
SharedPart shared_part(std::vector<SharedInformation> const& of_joints, std::size_t joint);

}  // namespace torquescope
