#pragma once
// How far a law that is not quite the joint's may have moved its own parameters: no less of what is wrong with it hides
// among its own columns than shows outside of them.
//
// Equation   E = excess (1 - 1.645 / z): energy that the model leaves beyond what noise does, surely (95 %); 0 where
//            that may be chance. shift of coefficient k = the most by which a signal of energy E among the columns
//            moves it when no coefficient leaves its bounds; without bounds sqrt(E (A^T A)^-1_kk)
// Why        least squares take up whatever of the difference between two laws looks like a column; only the rest is
//            seen. Neither twins of the named law nor parts of the record know of it: a flank without the catalogue's
//            damping moves the width of its gap in every tenth of the record alike
// Assumption the difference lies among the columns no stronger than beside them. It can: a law may differ by just a
// change of its parameters
// Shapes     columns: n x k, n >= k, of the model and the tangents of its shapes; result: k
// Threads    free function
// Source     discrepancy of a model as a part of what is not known: Kennedy, O'Hagan 2001; model error modelling: Ljung
//            1999

#include "engine/statistics/scaled_solution.hpp"
#include "engine/twin/mismatch_energy.hpp"

namespace torquescope {

// E
double sure_excess(MismatchEnergy const& left);

Eigen::VectorXd discrepancy_shifts(MismatchEnergy const& left, Eigen::MatrixXd const& columns,
                                   CoefficientBounds const& room);

}  // namespace torquescope
