#pragma once
// A root of the inverse of a Gram matrix, over the directions that are there: columns times it are orthonormal.
//
// Equation   root' square root = I
// Shapes     square: r x r; energy: r, of the columns before what they share with others was taken off; root: r x rank.
//            A direction that keeps less than a billionth of its energy is not there
// Threads    free function
// Source     Golub, Van Loan 2013, Matrix Computations, section 8.7 (whitening by the eigenvalue decomposition)

#include <Eigen/Core>

namespace torquescope {

Eigen::MatrixXd inverse_root(Eigen::Ref<Eigen::MatrixXd const> const& square,
                             Eigen::Ref<Eigen::VectorXd const> const& energy);

}  // namespace torquescope
