#pragma once
// Sums of the recording's and every replicate's residual over the cells of one axis, each direction of motion apart.
//
// Why apart  the residual itself shows what is even in the direction, the residual along the motion what is odd; both
//            come from the same sums
// Side       forward where `sign` > 0; sign is that of the velocity, or of the model's torque for
//            CellReading::along_torque
// Shapes     cells x (1 + M), the recording first, then the replicates
// Threads    spreads columns over `threads`; same bits for any number

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/infer/locate/map_axes.hpp"
#include "engine/infer/locate/mismatch_rows.hpp"

namespace torquescope {

struct CellSums {
  Eigen::VectorXd forward_rows{}, backward_rows{};  // per cell
  Eigen::VectorXd energy{};                         // per cell: of the recording's residual
  Eigen::MatrixXd forward{}, backward{};            // sums of residuals

  Eigen::VectorXd rows() const { return forward_rows + backward_rows; }
};

// cell_of: of each row, -1: none
CellSums sum_in_cells(MismatchRows const& rows, std::span<int const> cell_of, int n_cells, CellReading reading,
                      int threads);

// mean residual, read along the side's sign unless reading is torque; NaN in a cell without rows
Eigen::MatrixXd cell_means(CellSums const& sums, CellReading reading);

// rows * (mean - mean of replicates)^2: energy of what is constant in a cell and not in the replicates. The replicates'
// are larger by (M + 1) / (M - 1), so that a clean recording and a replicate, which is part of that mean, have the same
// expected energy
Eigen::MatrixXd cell_energies(CellSums const& sums, CellReading reading);
// the same with a mean of its own for either side
Eigen::MatrixXd two_sided_energies(CellSums const& sums);

}  // namespace torquescope
