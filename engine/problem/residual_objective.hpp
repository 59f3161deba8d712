#pragma once
// The fitness of a search on the linear problem: mean or summed loss of the residuals, and the gap to the optimum.
//
// Equation   fitness = sum_t loss(tau_t - phi_t x), divided by n for FitnessScale::mse
//            gap = MSE(x) - MSE(ols) = |R (x - ols)|^2 / n with phi = Q R: no difference of near-equal numbers, never
//            negative, exact down to rounding where the subtraction ends at 1e-16 of the MSE
// Shapes     candidates: members x R, row-major
// Layout     sorted by the columns that take few values where there are such (levelled_recording.hpp), else in time
// Bits       fitness has the same bits on every machine, thread count and grouping (kernels/residual_energy.hpp)
// Errors     Error 65 from the constructor when the data cannot tell the parameters apart
// Threads    const object, shared: the recording is packed once; one Workspace per thread

#include <Eigen/Core>
#include <optional>
#include <span>

#include "engine/optim/objective.hpp"
#include "engine/problem/levelled_recording.hpp"
#include "engine/problem/loss.hpp"
#include "engine/problem/regression_data.hpp"
#include "kernels/aligned_doubles.hpp"
#include "kernels/sample_tiles.hpp"

namespace torquescope {

enum class FitnessScale { mse, sse };

class ResidualObjective final : public Objective {
 public:
  ResidualObjective(RegressionData const& data, Bounds bounds, Loss loss = {}, FitnessScale scale = FitnessScale::mse);
  // the packed view points into this object
  ResidualObjective(ResidualObjective const&) = delete;
  ResidualObjective& operator=(ResidualObjective const&) = delete;

  Bounds const& bounds() const override { return bounds_; }
  void evaluate(MatrixView<double const> candidates, std::span<double> fitness, Workspace& workspace) const override;

  // whether the samples are sorted: fewer operations, other rounding than in time order
  bool is_levelled() const { return levelled_.has_value(); }
  Loss const& loss() const { return loss_; }
  FitnessScale scale() const { return scale_; }
  // fitness of this scale as mean loss: what histories are stored in
  double as_mean(double fitness) const { return scale_ == FitnessScale::mse ? fitness : fitness / n_rows_; }

  // squared error above the least possible, as MSE and whatever the loss; NaN for a NaN candidate
  double gap(std::span<double const> candidate) const;
  Eigen::VectorXd const& least_squares() const { return least_squares_; }  // the OLS parameters
  double floor_mse() const { return floor_mse_; }                          // their MSE

 private:
  void evaluate_levelled(kernels::Candidates const& block, double* energy, Workspace& workspace) const;
  void evaluate_in_time(kernels::Candidates const& block, double* energy, Workspace& workspace) const;

  Bounds bounds_;
  Loss loss_;
  FitnessScale scale_;
  double n_rows_;
  std::optional<LevelledRecording> levelled_;
  kernels::AlignedDoubles packed_;  // empty when levelled
  kernels::SampleTiles tiles_;
  Eigen::VectorXd least_squares_;
  double floor_mse_;
  Eigen::MatrixXd root_;  // upper triangular, root' root = phi' phi / n
};

}  // namespace torquescope
