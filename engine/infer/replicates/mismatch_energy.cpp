#include "engine/infer/replicates/mismatch_energy.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/fit/statistics/twin_null.hpp"

namespace torquescope {

double MismatchEnergy::excess_rms() const {
  return std::sqrt(std::max(0.0, excess) / static_cast<double>(std::max<Eigen::Index>(1, rows)));
}

MismatchEnergy mismatch_energy(MismatchRows const& rows) {
  auto const m = static_cast<double>(rows.n_twins());
  Eigen::MatrixXd const apart = rows.twins.colwise() - rows.twin_mean;
  double const variance = apart.squaredNorm() / (m - 1.0);

  // against the mean of the others a twin is m / (m - 1) times as far away, and m / (m - 1) times as variable
  std::vector<double> twins(static_cast<std::size_t>(rows.n_twins()));
  for (Eigen::Index t = 0; t < rows.n_twins(); ++t)
    twins[static_cast<std::size_t>(t)] = apart.col(t).squaredNorm() * m / (m - 1.0);
  double const data = (rows.residual - rows.twin_mean).squaredNorm() / (1.0 + 1.0 / m);

  MismatchEnergy result;
  result.rows = rows.size();
  result.residual = rows.residual.squaredNorm();
  result.noise = variance;
  result.excess = data - variance;
  result.z = twin_z(data, twins);
  result.p = tail_p(data, twins);
  return result;
}

}  // namespace torquescope
