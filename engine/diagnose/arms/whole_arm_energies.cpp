#include "engine/diagnose/arms/whole_arm_energies.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace torquescope {

Eigen::VectorXd noise_energies(WholeArmRows const& rows, Eigen::VectorXd const& residual, ArmStretch const& stretch,
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
  double const correlation = rows.recordings[stretch.recording].neighbour_correlation;
  Eigen::VectorXd energies = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(joints));
  for (std::size_t j = 0; j < joints; ++j)
    if (pairs[j] > 0.0)
      energies[static_cast<Eigen::Index>(j)] = count[j] * squares[j] / (2.0 * (1.0 - correlation) * pairs[j]);
  return energies;
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

Eigen::VectorXd energies_on(WholeArmRows const& rows, Eigen::VectorXd const& of, std::span<ArmStretch const> stretches,
                            std::size_t joints) {
  Eigen::VectorXd energies = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(joints));
  for (ArmStretch const& stretch : stretches)
    for (Eigen::Index i = stretch.rows.from; i < stretch.rows.to; ++i)
      energies[static_cast<Eigen::Index>(rows.rows[static_cast<std::size_t>(i)].joint)] += of[i] * of[i];
  return energies;
}

double explained_share(double before, double after, double noise) {
  return before > after ? (before - after) / (before - std::min(noise, after)) : 0.0;
}

double least_left_share(Eigen::VectorXd const& before, Eigen::VectorXd const& after) {
  double least = 1.0;
  for (Eigen::Index j = 0; j < before.size(); ++j)
    if (before[j] > 0.0) least = std::min(least, std::sqrt(after[j] / before[j]));
  return least;
}

}  // namespace torquescope
