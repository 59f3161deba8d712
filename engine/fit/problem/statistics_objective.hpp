#pragma once
// The fitness of a search from sufficient statistics: mean or summed squares without looking at a sample.
//
// Equation   sufficient_statistics.hpp; divided by n for FitnessScale::mse
// Shapes     candidates: members x R, row-major
// Bits       the same on every machine, thread count and grouping; equal to ResidualObjective to rounding only
// Threads    const object, shared; one Workspace per thread

#include <span>

#include "engine/fit/optim/objective.hpp"
#include "engine/fit/problem/residual_objective.hpp"
#include "engine/fit/problem/sufficient_statistics.hpp"

namespace torquescope {

class StatisticsObjective final : public Objective {
 public:
  // `statistics` must be usable, and is kept: it must outlive the objective
  StatisticsObjective(SufficientStatistics const& statistics, std::size_t n_rows, Bounds bounds,
                      FitnessScale scale = FitnessScale::mse);

  Bounds const& bounds() const override { return bounds_; }
  void evaluate(MatrixView<double const> candidates, std::span<double> fitness, Workspace& workspace) const override;

 private:
  SufficientStatistics const& statistics_;
  double n_rows_;
  Bounds bounds_;
  FitnessScale scale_;
};

}  // namespace torquescope
