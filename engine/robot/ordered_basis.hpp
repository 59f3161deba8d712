#pragma once
// Which columns of a matrix are independent of those before them, in a given order, and what makes up the others.
//
// Method     modified Gram-Schmidt, every projection twice; a column whose rest is below `tolerance` of its length is a
//            sum of the kept ones. One that is almost a sum waits until the clear ones are kept
// Requires   more rows than columns; columns that are zero have length below 1e-12 of the longest
// Source     Giraud, Langou, Rozloznik 2005, doi:10.1016/j.camwa.2005.08.009 (twice is enough)

#include <Eigen/Core>
#include <vector>

namespace torquescope {

struct OrderedBasis {
  std::vector<Eigen::Index> kept;  // ascending
  std::vector<Eigen::Index> zero;  // ascending
  Eigen::MatrixXd sums;            // kept x all columns: column = sum of sums(k, column) * kept column k
};

OrderedBasis ordered_basis(Eigen::MatrixXd const& columns, std::vector<Eigen::Index> const& order, double tolerance);

}  // namespace torquescope
