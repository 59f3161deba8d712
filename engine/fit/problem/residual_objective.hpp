#pragma once
// The fitness of a search on the linear problem: mean or summed loss of the residuals.
//
// Equation   fitness = sum_t loss(tau_t - phi_t x), divided by n for FitnessScale::mse
// Shapes     candidates: members x R, row-major
// Layout     sorted by the columns that take few values where there are such (levelled_recording.hpp), else in time
// Bits       fitness has the same bits on every machine, thread count and grouping (kernels/residual_energy.hpp)
// Threads    const object, shared: the recording is packed once; one Workspace per thread

#include <optional>
#include <span>

#include "engine/fit/optim/objective.hpp"
#include "engine/fit/problem/levelled_recording.hpp"
#include "engine/fit/problem/loss.hpp"
#include "engine/fit/problem/regression_data.hpp"
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
  std::size_t bytes_swept() const override {
    return levelled_ ? levelled_->bytes() : packed_.size() * sizeof(packed_.front());
  }
  void evaluate(MatrixView<double const> candidates, std::span<double> fitness, Workspace& workspace) const override;

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
};

}  // namespace torquescope
