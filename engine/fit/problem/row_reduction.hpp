#pragma once
// Householder QR of a linear problem block by block: what is kept of the rows already seen is a triangle.
//
// Equation   [triangle; next block] = Q [new triangle; 0], from the first block to the last but one; what remains,
//            [triangle; last block], has the R factor, the solution and the singular values of all rows
// Why        a QR of the whole needs a copy of the regressor or two; this one needs a block
// Error      as Householder QR of the whole: every step is an orthogonal transformation (Demmel, Grigori, Hoemmen,
//            Langou 2012, section 4); one block is the rows themselves, bit for bit
// Shapes     n rows, R columns; reduced: at most R + block_rows rows
// Bits       the same for any number of threads; block_rows changes last digits
// Threads    free functions
// Source     sequential TSQR: Demmel, Grigori, Hoemmen, Langou, SIAM J. Sci. Comput. 34 (2012) A206-A239

#include <Eigen/Core>

#include "engine/fit/problem/regression_data.hpp"

namespace torquescope {

// half a megabyte for R = 7: a block stays in the second cache
inline constexpr Eigen::Index reduced_block_rows = 8192;

// what is done to the rows on their way: row t times root_weight_t, column r times factor_r; empty: all 1
struct RowScaling {
  Eigen::VectorXd root_weight{};  // [n]
  Eigen::VectorXd factor{};       // [R], of the columns of phi, not of tau
};

struct ReducedRows {
  Eigen::MatrixXd phi;
  Eigen::VectorXd tau;
};

ReducedRows reduce_rows(RegressionData const& data, RowScaling const& scaling = {},
                        Eigen::Index block_rows = reduced_block_rows);

// What the health of a regressor and the floor of its squared errors both ask for. Up to block_rows rows each
struct Reductions {
  Eigen::VectorXd length;    // [R], of the columns of phi; 1 for a column of zeros
  ReducedRows unit_columns;  // of phi with columns of length one
  ReducedRows raw;
};

Reductions reductions_of(RegressionData const& data);

// scaled rows first .. first + count
Eigen::MatrixXd scaled_rows(RegressionData const& data, RowScaling const& scaling, Eigen::Index first,
                            Eigen::Index count);

// the R factor of the scaled phi, upper triangular; signs of its rows are arbitrary
Eigen::MatrixXd triangular_factor(RegressionData const& data, RowScaling const& scaling = {},
                                  Eigen::Index block_rows = reduced_block_rows);

// of rows reduced already
Eigen::MatrixXd triangular_factor(ReducedRows const& reduced);

// of every column of phi, the weighted rows
Eigen::VectorXd column_lengths(RegressionData const& data, Eigen::VectorXd const& root_weight = {});

}  // namespace torquescope
