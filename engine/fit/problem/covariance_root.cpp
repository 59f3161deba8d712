#include "engine/fit/problem/covariance_root.hpp"

#include <cmath>

#include "engine/base/dense_solvers.hpp"

namespace torquescope {

Eigen::MatrixXd covariance_root(Eigen::MatrixXd const& covariance) {
  Eigen::VectorXd const error = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  Eigen::VectorXd const per_error = (error.array() > 0.0).select(error.cwiseInverse(), 0.0);
  auto const axes = symmetric_axes(per_error.asDiagonal() * covariance * per_error.asDiagonal());
  return error.asDiagonal() * axes.vectors * axes.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

Eigen::MatrixXd largest_axes(Eigen::MatrixXd const& gram, double least_energy) {
  auto const axes = symmetric_axes(gram);
  Eigen::Index k = 0;
  while (k < gram.cols() && axes.values[gram.cols() - 1 - k] > least_energy) ++k;
  return axes.vectors.rightCols(k).rowwise().reverse();
}

Eigen::MatrixXd largest_parts(Eigen::MatrixXd const& columns, double least) {
  if (columns.cols() == 0) return columns;
  return columns * largest_axes(columns.transpose() * columns, least * least * static_cast<double>(columns.rows()));
}

}  // namespace torquescope
