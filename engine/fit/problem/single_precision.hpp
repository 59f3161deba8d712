#pragma once
// The fitness of a search in float32: half the memory, up to twice the speed, for recordings whose noise hides the
// rounding.
//
// Equation   fitness = sum_t (tau_t - phi_t x)^2, divided by n for FitnessScale::mse (kernels/float_energy.hpp)
// Shapes     candidates: members x R, row-major
// Refused    where least squares leaves less than 1e-3 of the torque (rms over rms): there the rounding of float32
//            decides which candidate is better
// Bits       fitness has the same bits on every machine, thread count and grouping
// Threads    const object, shared: the recording is packed once; one Workspace per thread

#include <span>
#include <string>
#include <vector>

#include "engine/fit/problem/residual_objective.hpp"
#include "engine/fit/problem/sufficient_statistics.hpp"
#include "kernels/float_energy.hpp"

namespace torquescope {

class SinglePrecisionObjective final : public Objective {
 public:
  SinglePrecisionObjective(RegressionData const& data, Bounds bounds, FitnessScale scale = FitnessScale::mse);
  // the packed view points into this object
  SinglePrecisionObjective(SinglePrecisionObjective const&) = delete;
  SinglePrecisionObjective& operator=(SinglePrecisionObjective const&) = delete;

  Bounds const& bounds() const override { return bounds_; }
  std::size_t bytes_swept() const override { return packed_.size() * sizeof(packed_.front()); }
  void evaluate(MatrixView<double const> candidates, std::span<double> fitness, Workspace& workspace) const override;

 private:
  Bounds bounds_;
  FitnessScale scale_;
  double n_rows_;
  kernels::AlignedFloats packed_;
  kernels::FloatTiles tiles_;
};

// what float32 would cost on these data
struct SinglePrecisionCheck {
  static constexpr double least_noise = 1e-3;

  double noise = 0.0;  // rms that least squares leaves over rms of the torque; NaN where the columns are dependent
  double error = 0.0;  // of the MSE, relative: the largest at least squares and on the line through it and zero
  bool usable() const { return noise >= least_noise; }
};

// evaluates 21 vectors in both precisions
SinglePrecisionCheck check_single_precision(RegressionData const& data, SufficientStatistics const& statistics);

}  // namespace torquescope
