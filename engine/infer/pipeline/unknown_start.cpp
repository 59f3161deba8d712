#include "engine/infer/pipeline/unknown_start.hpp"

#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {

Eigen::Index unknown_start(Eigen::VectorXd const& q, Eigen::VectorXd const& dq) {
  constexpr double share_of_range = 0.06, most_of_the_way = 0.1;
  TORQUESCOPE_EXPECT(q.size() == dq.size());
  Eigen::Index const n = q.size();
  if (n < 2) return 0;
  double const whole = (q.tail(n - 1) - q.head(n - 1)).cwiseAbs().sum();
  double const far = share_of_range * (q.maxCoeff() - q.minCoeff());
  double way = 0.0, since_turn = 0.0;
  for (Eigen::Index k = 1; k < n && way <= most_of_the_way * whole; ++k) {
    double const step = std::abs(q[k] - q[k - 1]);
    way += step;
    since_turn = dq[k] * dq[k - 1] < 0.0 ? 0.0 : since_turn + step;
    if (far > 0.0 && since_turn >= far) return k;
  }
  return 0;
}

}  // namespace torquescope
