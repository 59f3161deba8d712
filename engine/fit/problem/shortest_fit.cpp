#include "engine/fit/problem/shortest_fit.hpp"

#include "engine/base/dense_solvers.hpp"

namespace torquescope {

Eigen::VectorXd shortest_fit(std::vector<FilteredGram> const& grams, Eigen::Index n_parameters,
                             Eigen::VectorXd const& deviation) {
  constexpr double in_the_rows = 1e-12;
  PooledSquares const pooled = pooled_squares(grams, n_parameters, deviation.cwiseAbs2());
  // a column of nothing has length one: it gets no value
  Eigen::VectorXd const length = pooled.information.diagonal().cwiseSqrt();
  Eigen::VectorXd const scale = (length.array() > 0.0).select(length.cwiseInverse(), 1.0);
  auto const axes = symmetric_axes(scale.asDiagonal() * pooled.information * scale.asDiagonal());
  Eigen::VectorXd const& size = axes.values;
  Eigen::VectorXd along = axes.vectors.transpose() * scale.cwiseProduct(pooled.right);
  for (Eigen::Index k = 0; k < along.size(); ++k)
    along[k] = size[k] > in_the_rows * size[size.size() - 1] ? along[k] / size[k] : 0.0;
  return scale.cwiseProduct(axes.vectors * along);
}

}  // namespace torquescope
