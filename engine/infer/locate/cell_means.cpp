#include "engine/infer/locate/cell_means.hpp"

#include "engine/base/contract.hpp"
#include "engine/base/parallel.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {
namespace {

Eigen::MatrixXd read(CellSums const& sums, CellReading reading) {
  return reading == CellReading::torque ? Eigen::MatrixXd(sums.forward + sums.backward)
                                        : Eigen::MatrixXd(sums.forward - sums.backward);
}

Eigen::MatrixXd energies_beyond_replicates(Eigen::MatrixXd const& sums, Eigen::VectorXd const& rows) {
  Eigen::Index const n_replicates = sums.cols() - 1;
  double const m = static_cast<double>(n_replicates);
  Eigen::VectorXd const replicate_mean = sums.rightCols(n_replicates).rowwise().mean();
  // a cell without rows has no sum either
  Eigen::ArrayXd const per_row = rows.array().max(1.0).inverse();
  Eigen::MatrixXd energies = (sums.colwise() - replicate_mean).array().square().colwise() * per_row;
  energies.rightCols(n_replicates) *= (m + 1.0) / (m - 1.0);
  return energies;
}

}  // namespace

CellSums sum_in_cells(MismatchRows const& rows, std::span<int const> cell_of, int n_cells, CellReading reading,
                      int threads) {
  TORQUESCOPE_EXPECT(static_cast<Eigen::Index>(cell_of.size()) == rows.size());
  Eigen::VectorXd const& sign = reading == CellReading::along_torque ? rows.model_torque : rows.dq;
  Eigen::Index const columns = rows.n_replicates() + 1;
  // one list of places for both sides: backward after forward
  std::vector<Eigen::Index> place(cell_of.size());
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(2 * n_cells), energy = counts;
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    auto const row = static_cast<std::size_t>(i);
    place[row] = cell_of[row] < 0 ? -1 : cell_of[row] + (sign[i] < 0.0 ? n_cells : 0);
    if (place[row] < 0) continue;
    counts[place[row]] += 1.0;
    energy[place[row]] += rows.residual[i] * rows.residual[i];
  }

  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(2 * n_cells, columns);
  parallel_for(static_cast<std::size_t>(columns), threads, [&](std::size_t task, int) {
    auto const column = static_cast<Eigen::Index>(task);
    double const* const residual = column == 0 ? rows.residual.data() : rows.replicates.col(column - 1).data();
    auto sum = sums.col(column);
    for (std::size_t row = 0; row < place.size(); ++row)
      if (place[row] >= 0) sum[place[row]] += residual[row];
  });

  CellSums result;
  result.forward_rows = counts.head(n_cells);
  result.backward_rows = counts.tail(n_cells);
  result.energy = energy.head(n_cells) + energy.tail(n_cells);
  result.forward = sums.topRows(n_cells);
  result.backward = sums.bottomRows(n_cells);
  return result;
}

Eigen::MatrixXd cell_means(CellSums const& sums, CellReading reading) {
  Eigen::MatrixXd means = read(sums, reading);
  Eigen::VectorXd const rows = sums.rows();
  for (Eigen::Index cell = 0; cell < means.rows(); ++cell)
    if (rows[cell] > 0.0)
      means.row(cell) /= rows[cell];
    else
      means.row(cell).setConstant(unknown);
  return means;
}

Eigen::MatrixXd cell_energies(CellSums const& sums, CellReading reading) {
  return energies_beyond_replicates(read(sums, reading), sums.rows());
}

Eigen::MatrixXd two_sided_energies(CellSums const& sums) {
  return energies_beyond_replicates(sums.forward, sums.forward_rows) +
         energies_beyond_replicates(sums.backward, sums.backward_rows);
}

}  // namespace torquescope
