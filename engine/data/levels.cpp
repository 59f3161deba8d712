#include "engine/data/levels.hpp"

#include <algorithm>

namespace torquescope::levels {

double independent_rows(Eigen::Ref<Eigen::VectorXd const> const& residual) {
  Eigen::Index const n = residual.size();
  double const energy = residual.squaredNorm();
  if (n < 2 || !(energy > 0.0)) return static_cast<double>(n);
  double const r =
      std::clamp(residual.head(n - 1).dot(residual.tail(n - 1)) / energy, 0.0, 1.0 - 1.0 / static_cast<double>(n));
  return static_cast<double>(n) * (1.0 - r) / (1.0 + r);
}

}  // namespace torquescope::levels
