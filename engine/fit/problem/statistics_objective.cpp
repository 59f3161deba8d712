#include "engine/fit/problem/statistics_objective.hpp"

#include "engine/base/contract.hpp"

namespace torquescope {

StatisticsObjective::StatisticsObjective(SufficientStatistics const& statistics, std::size_t n_rows, Bounds bounds,
                                         FitnessScale scale)
    : statistics_(statistics), n_rows_(static_cast<double>(n_rows)), bounds_(std::move(bounds)), scale_(scale) {
  TORQUESCOPE_EXPECT(statistics.usable());
  TORQUESCOPE_EXPECT(bounds_.dimension() == static_cast<std::size_t>(statistics.centre().size()));
}

void StatisticsObjective::evaluate(MatrixView<double const> candidates, std::span<double> fitness,
                                   Workspace& workspace) const {
  TORQUESCOPE_EXPECT(candidates.columns() == dimension() && fitness.size() == candidates.rows());
  auto const needed = kernels::quadratic_workspace_size(dimension());
  if (workspace.numbers.size() < needed) workspace.numbers.resize(needed);
  kernels::quadratic_energy(statistics_.form(), {candidates.data(), candidates.rows(), candidates.columns()},
                            fitness.data(), workspace.numbers.data());
  if (scale_ == FitnessScale::mse)
    for (auto& value : fitness) value /= n_rows_;
}

}  // namespace torquescope
