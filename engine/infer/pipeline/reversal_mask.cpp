#include "engine/infer/pipeline/reversal_mask.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

constexpr double still_share = 0.005;     // of the motion's speed
constexpr double reach_in_periods = 1.6;  // of the cut-off

// The peak, but no more than three times the speed that a twentieth of the record exceeds: one fast move does not hide
// a slow test. Where that speed is still beside the peak, all but a twentieth is rest, and the peak counts
double speed_of(Eigen::VectorXd const& dq) {
  constexpr double below = 0.95, most = 3.0;
  std::vector<double> speeds(static_cast<std::size_t>(dq.size()));
  for (std::size_t k = 0; k < speeds.size(); ++k) speeds[k] = std::abs(dq[static_cast<Eigen::Index>(k)]);
  auto const at = speeds.begin() + static_cast<std::ptrdiff_t>(below * static_cast<double>(speeds.size() - 1));
  std::nth_element(speeds.begin(), at, speeds.end());
  double const peak = dq.cwiseAbs().maxCoeff();
  return *at < still_share * peak ? peak : std::min(peak, most * *at);
}

double still_speed(Eigen::VectorXd const& dq) { return dq.size() > 0 ? still_share * speed_of(dq) : 0.0; }

bool is_still(double dq, double slowest) { return std::abs(dq) < slowest || dq == 0.0; }

}  // namespace

Eigen::Index mask_reach(double rate_hz, double cutoff_hz) {
  TORQUESCOPE_EXPECT(rate_hz > 0.0 && cutoff_hz >= 0.0);
  return cutoff_hz > 0.0 ? static_cast<Eigen::Index>(std::ceil(reach_in_periods / cutoff_hz * rate_hz)) : 0;
}

std::vector<bool> moving_samples(Eigen::VectorXd const& dq, double rate_hz, double cutoff_hz) {
  Eigen::Index const n = dq.size(), reach = mask_reach(rate_hz, cutoff_hz);
  double const slowest = still_speed(dq);

  std::vector<bool> moving(static_cast<std::size_t>(n), true);
  // each sample is written once, however long the joint stands still
  Eigen::Index dropped_to = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    bool const turned = k > 0 && dq[k] * dq[k - 1] < 0.0;
    if (!turned && !is_still(dq[k], slowest)) continue;
    Eigen::Index const end = std::min(n, k + reach + 1);
    for (Eigen::Index i = std::max({Eigen::Index{0}, k - reach, dropped_to}); i < end; ++i)
      moving[static_cast<std::size_t>(i)] = false;
    dropped_to = end;
  }
  return moving;
}

}  // namespace torquescope
