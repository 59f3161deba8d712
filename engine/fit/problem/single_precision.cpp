#include "engine/fit/problem/single_precision.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/contract.hpp"

namespace torquescope {

SinglePrecisionObjective::SinglePrecisionObjective(RegressionData const& data, Bounds bounds, FitnessScale scale)
    : bounds_(std::move(bounds)), scale_(scale), n_rows_(static_cast<double>(data.rows())) {
  TORQUESCOPE_EXPECT(bounds_.dimension() == static_cast<std::size_t>(data.parameters()));
  auto const rows = static_cast<std::size_t>(data.rows());
  packed_.resize(kernels::packed_size<float>(rows, dimension()));
  tiles_ = kernels::pack_tiles(data.phi.data(), static_cast<std::size_t>(data.phi.outerStride()), data.tau.data(), rows,
                               dimension(), packed_.data());
}

void SinglePrecisionObjective::evaluate(MatrixView<double const> candidates, std::span<double> fitness,
                                        Workspace& workspace) const {
  TORQUESCOPE_EXPECT(candidates.columns() == dimension() && fitness.size() == candidates.rows());
  std::size_t const n_members = candidates.rows();
  std::size_t const floats = kernels::float_workspace_size(dimension(), n_members);
  std::size_t const doubles = kernels::float_sums_size(tiles_.n_samples, n_members);
  if (workspace.singles.size() < floats) workspace.singles.resize(floats);
  if (workspace.numbers.size() < doubles) workspace.numbers.resize(doubles);
  kernels::float_residual_energy(tiles_, {candidates.data(), n_members, candidates.columns()}, fitness.data(),
                                 workspace.singles.data(), workspace.numbers.data());
  if (scale_ == FitnessScale::mse)
    for (auto& value : fitness) value /= n_rows_;
}

SinglePrecisionCheck check_single_precision(RegressionData const& data, SufficientStatistics const& statistics) {
  SinglePrecisionCheck check;
  check.noise = std::sqrt(statistics.noise_share());
  if (!check.usable()) return check;

  constexpr int steps = 10;  // of a thousandth to each side
  auto const R = static_cast<std::size_t>(data.parameters());
  Bounds const anywhere{std::vector<double>(R, -1.0), std::vector<double>(R, 1.0)};
  SinglePrecisionObjective const objective(data, anywhere);
  Workspace workspace;
  for (int step = -steps; step <= steps; ++step) {
    Eigen::VectorXd const v = (1.0 + 1e-3 * step) * statistics.centre();
    double single = 0.0;
    objective.evaluate({v.data(), 1, R}, {&single, 1}, workspace);
    double const exact = (data.tau - data.phi * v).squaredNorm() / static_cast<double>(data.rows());
    check.error = std::max(check.error, std::abs(single / exact - 1.0));
  }
  return check;
}

}  // namespace torquescope
