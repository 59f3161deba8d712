#include "engine/simulate/autoregression.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {

Autoregression white(double std) { return {std, std, {}}; }

double autocorrelation(Eigen::Ref<Eigen::VectorXd const> const& x, Eigen::Index lag) {
  TORQUESCOPE_EXPECT(lag >= 0 && lag < x.size());
  double const energy = x.squaredNorm();
  Eigen::Index const n = x.size() - lag;
  return energy > 0.0 ? x.head(n).dot(x.tail(n)) / energy : 0.0;
}

Autoregression fit_autoregression(Eigen::Ref<Eigen::VectorXd const> const& x) {
  TORQUESCOPE_EXPECT(x.size() > 0);
  double const n = static_cast<double>(x.size());
  double const variance = x.squaredNorm() / n;
  Autoregression best = white(std::sqrt(variance));
  if (variance == 0.0) return best;

  int const order_limit = static_cast<int>(std::min<Eigen::Index>(largest_order, x.size() / 4));
  std::vector<double> a;
  double innovation = variance;
  double best_criterion = n * std::log(innovation);
  for (int order = 1; order <= order_limit; ++order) {
    // one step of the Levinson recursion
    double reflection = autocorrelation(x, order) * variance;
    for (int i = 1; i < order; ++i)
      reflection -= a[static_cast<std::size_t>(i - 1)] * autocorrelation(x, order - i) * variance;
    reflection /= innovation;
    std::vector<double> longer = a;
    for (std::size_t i = 0; i < a.size(); ++i) longer[i] -= reflection * a[a.size() - 1 - i];
    longer.push_back(reflection);
    a = longer;
    innovation *= (1.0 - reflection) * (1.0 + reflection);
    // nothing new from here on: the past already tells everything
    if (innovation <= variance * 1e-12) break;

    double const criterion = n * std::log(innovation) + 2.0 * order;
    if (criterion < best_criterion) {
      best_criterion = criterion;
      best.past = a;
      best.innovation = std::sqrt(innovation);
    }
  }
  return best;
}

}  // namespace torquescope
