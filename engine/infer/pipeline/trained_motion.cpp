#include "engine/infer/pipeline/trained_motion.hpp"

#include <algorithm>
#include <cmath>

#include "engine/fit/statistics/bounded_projection.hpp"
#include "engine/fit/statistics/scaled_solution.hpp"

namespace torquescope {

TrainedMotion trained_motion(Eigen::MatrixXd const& columns, double memory) {
  return {std::sqrt(memory) * solve_scaled(columns, orthonormal_basis(columns))};
}

std::vector<bool> samples_outside(TrainedMotion const& trained, Eigen::MatrixXd const& columns, Eigen::Index reach) {
  Eigen::VectorXd const leverage = (columns * trained.coordinates).rowwise().squaredNorm();
  Eigen::Index const n = leverage.size();
  std::vector<bool> outside(static_cast<std::size_t>(n), false);
  Eigen::Index marked = 0;  // each sample is written once
  for (Eigen::Index k = 0; k < n; ++k) {
    if (!(leverage[k] > 1.0)) continue;
    Eigen::Index const end = std::min(n, k + reach + 1);
    for (Eigen::Index i = std::max({Eigen::Index{0}, k - reach, marked}); i < end; ++i)
      outside[static_cast<std::size_t>(i)] = true;
    marked = end;
  }
  return outside;
}

}  // namespace torquescope
