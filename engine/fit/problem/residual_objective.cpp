#include "engine/fit/problem/residual_objective.hpp"

#include "engine/base/contract.hpp"
#include "kernels/levelled_energy.hpp"
#include "kernels/residual_energy.hpp"

namespace torquescope {
namespace {

double* room(Workspace& workspace, std::size_t needed) {
  if (workspace.numbers.size() < needed) workspace.numbers.resize(needed);
  return workspace.numbers.data();
}

}  // namespace

ResidualObjective::ResidualObjective(RegressionData const& data, Bounds bounds, Loss loss, FitnessScale scale)
    : bounds_(std::move(bounds)), loss_(loss), scale_(scale), n_rows_(static_cast<double>(data.rows())) {
  TORQUESCOPE_EXPECT(bounds_.dimension() == static_cast<std::size_t>(data.parameters()));
  TORQUESCOPE_EXPECT(loss_.delta > 0.0);
  levelled_ = LevelledRecording::make(data.phi, data.tau);
  if (levelled_) return;
  auto const rows = static_cast<std::size_t>(data.rows());
  packed_.resize(kernels::packed_size(rows, dimension()));
  tiles_ = kernels::pack_tiles(data.phi.data(), static_cast<std::size_t>(data.phi.outerStride()), data.tau.data(), rows,
                               dimension(), packed_.data());
}

void ResidualObjective::evaluate(MatrixView<double const> candidates, std::span<double> fitness,
                                 Workspace& workspace) const {
  TORQUESCOPE_EXPECT(candidates.columns() == dimension() && fitness.size() == candidates.rows());
  kernels::Candidates const block{candidates.data(), candidates.rows(), candidates.columns()};
  if (levelled_)
    evaluate_levelled(block, fitness.data(), workspace);
  else
    evaluate_in_time(block, fitness.data(), workspace);

  if (scale_ == FitnessScale::mse)
    for (auto& value : fitness) value /= n_rows_;
}

void ResidualObjective::evaluate_levelled(kernels::Candidates const& block, double* energy,
                                          Workspace& workspace) const {
  auto const tiles = levelled_->tiles();
  double* const numbers = room(workspace, kernels::levelled_workspace_size(tiles, block.n_members));
  if (loss_.kind == LossKind::squares)
    kernels::levelled_residual_energy(tiles, block, energy, numbers);
  else
    kernels::levelled_huber_energy(tiles, block, loss_.delta, energy, numbers);
}

void ResidualObjective::evaluate_in_time(kernels::Candidates const& block, double* energy, Workspace& workspace) const {
  double* const numbers =
      room(workspace, kernels::energy_workspace_size(tiles_.n_samples, tiles_.n_regressors, block.n_members));
  if (loss_.kind == LossKind::squares)
    kernels::residual_energy(tiles_, block, energy, numbers);
  else
    kernels::huber_energy(tiles_, block, loss_.delta, energy, numbers);
}

}  // namespace torquescope
