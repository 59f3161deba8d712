#include "engine/arms/whole_arm_energies.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace torquescope {

double noise_energy(WholeArmRows const& rows, Eigen::VectorXd const& residual, ArmStretch const& stretch,
                    std::size_t joints) {
  RowBlock const& block = stretch.rows;
  std::vector<Eigen::Index> last(joints, -1);
  std::vector<double> squares(joints, 0.0), pairs(joints, 0.0), count(joints, 0.0);
  for (Eigen::Index i = block.from; i < block.to; ++i) {
    ArmRow const& row = rows.rows[static_cast<std::size_t>(i)];
    count[row.joint] += 1.0;
    Eigen::Index& before = last[row.joint];
    if (before >= 0 && rows.rows[static_cast<std::size_t>(before)].instant + 1 == row.instant) {
      double const step = residual[i] - residual[before];
      squares[row.joint] += step * step;
      pairs[row.joint] += 1.0;
    }
    before = i;
  }
  double energy = 0.0;
  for (std::size_t j = 0; j < joints; ++j)
    if (pairs[j] > 0.0) energy += count[j] * squares[j] / (2.0 * (1.0 - stretch.noise_correlation) * pairs[j]);
  return energy;
}

double plain_energy(WholeArmRows const& rows, Eigen::VectorXd const& noise, Eigen::VectorXd const& of, RowBlock block) {
  double energy = 0.0;
  for (Eigen::Index i = block.from; i < block.to; ++i) {
    double const scale = noise[static_cast<Eigen::Index>(rows.rows[static_cast<std::size_t>(i)].joint)];
    energy += scale * scale * of[i] * of[i];
  }
  return energy;
}

double energy_on(Eigen::VectorXd const& of, RowBlock const& block) {
  return of.segment(block.from, block.size()).squaredNorm();
}

double least_left_share(WholeArmRows const& rows, Eigen::VectorXd const& before, Eigen::VectorXd const& after,
                        std::span<ArmStretch const> stretches, std::size_t joints) {
  std::vector<double> was(joints, 0.0), is(joints, 0.0);
  for (ArmStretch const& stretch : stretches)
    for (Eigen::Index i = stretch.rows.from; i < stretch.rows.to; ++i) {
      std::size_t const joint = rows.rows[static_cast<std::size_t>(i)].joint;
      was[joint] += before[i] * before[i];
      is[joint] += after[i] * after[i];
    }
  double least = 1.0;
  for (std::size_t j = 0; j < joints; ++j)
    if (was[j] > 0.0) least = std::min(least, std::sqrt(is[j] / was[j]));
  return least;
}

}  // namespace torquescope
