#include "engine/fit/statistics/inverse_root.hpp"

#include <cmath>

#include "engine/base/dense_solvers.hpp"

namespace torquescope {

Eigen::MatrixXd inverse_root(Eigen::Ref<Eigen::MatrixXd const> const& square,
                             Eigen::Ref<Eigen::VectorXd const> const& energy) {
  constexpr double there = 1e-9;
  Eigen::VectorXd const scale = energy.unaryExpr([](double e) { return e > 0.0 ? 1.0 / std::sqrt(e) : 0.0; });
  auto const axes = symmetric_axes(scale.asDiagonal() * square * scale.asDiagonal());
  Eigen::Index const n = square.rows();
  Eigen::Index rank = 0;
  while (rank < n && axes.values[n - 1 - rank] > there) ++rank;
  return scale.asDiagonal() * axes.vectors.rightCols(rank) *
         axes.values.tail(rank).cwiseSqrt().cwiseInverse().asDiagonal();
}

}  // namespace torquescope
