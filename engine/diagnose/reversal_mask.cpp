#include "engine/diagnose/reversal_mask.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {

std::vector<bool> moving_samples(Eigen::VectorXd const& dq, double rate_hz, double cutoff_hz) {
  TORQUESCOPE_EXPECT(rate_hz > 0.0 && cutoff_hz >= 0.0);
  constexpr double still_share = 0.005;     // of the peak speed
  constexpr double reach_in_periods = 1.6;  // of the cut-off
  Eigen::Index const n = dq.size();
  Eigen::Index const reach =
      cutoff_hz > 0.0 ? static_cast<Eigen::Index>(std::ceil(reach_in_periods / cutoff_hz * rate_hz)) : 0;
  double const still_speed = n > 0 ? still_share * dq.cwiseAbs().maxCoeff() : 0.0;

  std::vector<bool> moving(static_cast<std::size_t>(n), true);
  // each sample is written once, however long the joint stands still
  Eigen::Index dropped_to = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    bool const turned = k > 0 && dq[k] * dq[k - 1] < 0.0;
    if (!turned && !(std::abs(dq[k]) < still_speed) && dq[k] != 0.0) continue;
    Eigen::Index const end = std::min(n, k + reach + 1);
    for (Eigen::Index i = std::max({Eigen::Index{0}, k - reach, dropped_to}); i < end; ++i)
      moving[static_cast<std::size_t>(i)] = false;
    dropped_to = end;
  }
  return moving;
}

}  // namespace torquescope
