#pragma once
// How far a slightly wrong law may have moved its own parameters (METHOD.md, Intervals).
//
// Equation   E = excess (1 - 1.645 / z): energy that the model leaves beyond noise (one-sided 95 %), 0 where that may
//            be chance. shift of coefficient k = the most by which a signal of energy E among the columns moves it
//            within the bounds; without bounds sqrt(E (A^T A)^-1_kk)
// Assumption what is wrong with the law is no larger among its columns than beside them
// Shapes     columns: n x k, n >= k, of the model and the tangents of its shapes; result: k
// Threads    free function
// Source     Kennedy, O'Hagan 2001, doi:10.1111/1467-9868.00294; Ljung 1999, Model validation and model error modeling

#include "engine/fit/statistics/scaled_solution.hpp"
#include "engine/infer/replicates/mismatch_energy.hpp"

namespace torquescope {

// E
double sure_excess(MismatchEnergy const& left);

Eigen::VectorXd discrepancy_shifts(MismatchEnergy const& left, Eigen::MatrixXd const& columns,
                                   CoefficientBounds const& room);

}  // namespace torquescope
