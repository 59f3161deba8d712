#include "engine/simulate/rollout/effective_samples.hpp"

#include <algorithm>

namespace torquescope {

double effective_samples(Eigen::Ref<Eigen::VectorXd const> const& residual) {
  // longer memories than a tenth of the stretch cannot be told from chance, and cost more than they say
  constexpr Eigen::Index most_lags = 2000, tenth = 10;
  Eigen::Index const n = residual.size();
  double const energy = residual.squaredNorm();
  if (n < 2 || !(energy > 0.0)) return static_cast<double>(n);
  Eigen::Index const lags = std::clamp<Eigen::Index>(n / tenth, 1, most_lags);
  double sum = 0.0;
  for (Eigen::Index k = 1; k <= lags; ++k) {
    double const rho = residual.head(n - k).dot(residual.tail(n - k)) / energy;
    sum += (1.0 - static_cast<double>(k) / static_cast<double>(lags + 1)) * rho * rho;
  }
  return static_cast<double>(n) / (1.0 + 2.0 * sum);
}

}  // namespace torquescope
