#include "engine/fit/problem/row_reduction.hpp"

#include <algorithm>

#include "engine/base/contract.hpp"
#include "engine/base/dense_solvers.hpp"

namespace torquescope {
namespace {

Eigen::VectorXd scaled_torque(RegressionData const& data, RowScaling const& scaling, Eigen::Index first,
                              Eigen::Index count) {
  if (scaling.root_weight.size() == 0) return data.tau.segment(first, count);
  return scaling.root_weight.segment(first, count).cwiseProduct(data.tau.segment(first, count));
}

}  // namespace

Eigen::MatrixXd scaled_rows(RegressionData const& data, RowScaling const& scaling, Eigen::Index first,
                            Eigen::Index count) {
  Eigen::MatrixXd rows = data.phi.middleRows(first, count);
  if (scaling.root_weight.size() > 0) rows = scaling.root_weight.segment(first, count).asDiagonal() * rows;
  if (scaling.factor.size() > 0) rows *= scaling.factor.asDiagonal();
  return rows;
}

ReducedRows reduce_rows(RegressionData const& data, RowScaling const& scaling, Eigen::Index block_rows) {
  TORQUESCOPE_EXPECT(block_rows > 0 && data.rows() > 0);
  Eigen::Index const n = data.rows(), R = data.parameters();
  // torque is one more column: its part of the triangle is Q' tau
  Eigen::MatrixXd triangle(0, R + 1), stack;
  Eigen::Index first = 0;
  for (; first + block_rows < n; first += block_rows) {
    stack.resize(triangle.rows() + block_rows, R + 1);
    stack.topRows(triangle.rows()) = triangle;
    stack.bottomLeftCorner(block_rows, R) = scaled_rows(data, scaling, first, block_rows);
    stack.bottomRightCorner(block_rows, 1) = scaled_torque(data, scaling, first, block_rows);
    triangle = triangle_of(stack);
  }

  // a row below the R-th holds no regressor, only torque that nothing can fit
  Eigen::Index const above = std::min(triangle.rows(), R), last = n - first;
  ReducedRows reduced{Eigen::MatrixXd(above + last, R), Eigen::VectorXd(above + last)};
  reduced.phi.topRows(above) = triangle.topLeftCorner(above, R);
  reduced.tau.head(above) = triangle.col(R).head(above);
  reduced.phi.bottomRows(last) = scaled_rows(data, scaling, first, last);
  reduced.tau.tail(last) = scaled_torque(data, scaling, first, last);
  return reduced;
}

Reductions reductions_of(RegressionData const& data) {
  Reductions reductions;
  reductions.raw = reduce_rows(data);
  // orthogonal transformations keep lengths, and scaling a column before or after them is the same
  reductions.length = reductions.raw.phi.colwise().norm();
  for (auto& length : reductions.length) length = length > 0.0 ? length : 1.0;
  reductions.unit_columns = {reductions.raw.phi * reductions.length.cwiseInverse().asDiagonal(), reductions.raw.tau};
  return reductions;
}

Eigen::MatrixXd triangular_factor(ReducedRows const& reduced) {
  TORQUESCOPE_EXPECT(reduced.phi.rows() >= reduced.phi.cols());
  return triangle_of(reduced.phi);
}

Eigen::MatrixXd triangular_factor(RegressionData const& data, RowScaling const& scaling, Eigen::Index block_rows) {
  return triangular_factor(reduce_rows(data, scaling, block_rows));
}

Eigen::VectorXd column_lengths(RegressionData const& data, Eigen::VectorXd const& root_weight) {
  if (root_weight.size() == 0) return data.phi.colwise().norm();
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(data.parameters());
  for (Eigen::Index first = 0; first < data.rows(); first += reduced_block_rows) {
    auto const count = std::min(reduced_block_rows, data.rows() - first);
    squares += scaled_rows(data, {root_weight, {}}, first, count).colwise().squaredNorm();
  }
  return squares.cwiseSqrt();
}

}  // namespace torquescope
