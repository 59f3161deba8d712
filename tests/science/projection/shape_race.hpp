#pragma once
// Who finds the effect of a planted mismatch with fewer evaluations: a search in the shapes alone, the linear
// parameters solved inside, or the same optimiser in all parameters at once.
//
// Evaluation one = the columns of the effect at one shape, through the filter, and an energy; points of a grid count
// Energy     of mismatch - baseline columns * shifts - columns(shape) * linear, on the common rows; both objectives are
//            its mean square, and the projected one is its minimum over shifts and linear (signs kept)
// Target     (1 + target_excess) times the best energy known
// Units      candidates in the unit scale of their ranges, so that no method is hurt by the size of a unit
// Threads    const objects; one race, one thread
// Source     Golub, Pereyra 1973 (variable projection)

#include <cstdint>
#include <string>

#include "engine/fit/optim/objective.hpp"
#include "engine/infer/search/shape_grid.hpp"
#include "engine/infer/search/shape_refinement.hpp"
#include "science/projection/planted_mismatch.hpp"

namespace torquescope::test {

inline constexpr double target_excess = 1e-3;

// of the shapes alone
class ProjectedEnergy final : public Objective {
 public:
  explicit ProjectedEnergy(PlantedMismatch const& planted);
  Bounds const& bounds() const override { return bounds_; }
  void evaluate(MatrixView<double const> candidates, std::span<double> fitness, Workspace&) const override;

  double at(std::vector<double> const& shape) const;
  // of a gain that refine_shape() reports
  double left_by(double gain) const;

 private:
  PlantedMismatch const& planted_;
  std::vector<ParameterRange> ranges_;
  Bounds bounds_;
  double whole_ = 0.0;  // energy beside the baseline
};

// of shapes, the effect's linear parameters, and shifts of the baseline's, in that order
class FullEnergy final : public Objective {
 public:
  explicit FullEnergy(PlantedMismatch const& planted);
  Bounds const& bounds() const override { return bounds_; }
  void evaluate(MatrixView<double const> candidates, std::span<double> fitness, Workspace&) const override;

  // the candidate that is best at this shape; outside the unit cube where the box does not hold it
  std::vector<double> best_at(std::vector<double> const& shape) const;

 private:
  PlantedMismatch const& planted_;
  std::vector<ParameterRange> ranges_;
  Bounds bounds_;
};

struct RaceEnd {
  std::int64_t evaluations = 0;  // until the target, or all that were made
  bool reached = false;
  double best = 0.0;  // mean square
};

// any optimiser of the registry with `members`, until the target or the budget
RaceEnd race(std::string const& optimiser, std::int64_t members, Objective const& objective, double target,
             std::int64_t most_evaluations, RandomKey key);

// what a diagnosis does: the grid, the optimiser round its best point, Levenberg-Marquardt from there; the optimiser is
// left out with generations = -1
RaceEnd race_as_diagnosed(PlantedMismatch const& planted, ShapeSearch const& search, double target);

struct BestKnown {
  std::vector<double> shape;
  double energy = 0.0;  // mean square
};
// a long refinement round the truth and round each of the three best points of the grid
BestKnown best_known(PlantedMismatch const& planted);

}  // namespace torquescope::test
