#include "engine/statistics/region_consistency.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "engine/base/contract.hpp"

namespace torquescope {
namespace {

constexpr double least_share = 0.7;
constexpr double unlucky = 0.05;  // of the twins

// the effect's torque on its region, zero elsewhere
Eigen::VectorXd inside_region(Eigen::VectorXd const& torque) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(torque.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return std::abs(torque[a]) > std::abs(torque[b]); });
  Eigen::VectorXd inside = Eigen::VectorXd::Zero(torque.size());
  double const wanted = region_energy * torque.squaredNorm();
  double held = 0.0;
  for (Eigen::Index row : order) {
    if (held >= wanted) break;
    inside[row] = torque[row];
    held += torque[row] * torque[row];
  }
  return inside;
}

}  // namespace

RegionConsistency region_consistency(Eigen::VectorXd const& torque, Eigen::VectorXd const& mismatch,
                                     Eigen::MatrixXd const& twins) {
  TORQUESCOPE_EXPECT(mismatch.size() == torque.size() && twins.rows() == torque.size() && twins.cols() > 0);
  double const own = torque.squaredNorm();
  TORQUESCOPE_EXPECT(own > 0.0);
  Eigen::VectorXd const inside = inside_region(torque);
  double const own_inside = inside.squaredNorm();

  // energy taken on a row: m^2 - (m - f)^2 = 2 m f - f^2
  RegionConsistency result;
  result.share = (2.0 * mismatch.dot(inside) - own_inside) / (2.0 * mismatch.dot(torque) - own);

  // the same where the mismatch is this effect and a twin's noise
  Eigen::VectorXd const noise_inside = twins.transpose() * inside, noise = twins.transpose() * torque;
  Eigen::VectorXd shares = (own_inside + 2.0 * noise_inside.array()) / (own + 2.0 * noise.array()).max(unlucky * own);
  std::sort(shares.begin(), shares.end());
  auto const rank = static_cast<Eigen::Index>(unlucky * static_cast<double>(shares.size()));
  result.asked_for = std::min(least_share, shares[rank]);
  return result;
}

}  // namespace torquescope
