#pragma once
// What happens to a trial vector's parameter outside the box.
//
//   midpoint   halfway between the target's parameter and the bound it crossed (JADE, L-SHADE): keeps the direction
//   clip       onto the bound
//   reflect    mirrored at the bounds until inside
//   random     uniform in the box anew (pagmo's choice): one draw per repaired parameter
//
// Promise    every parameter ends inside the box, bounds included, whatever the mutant was (also inf and NaN)
// Requires   the target is inside the box
// Source     the seed gives no box and no handling; midpoint: Zhang, Sanderson: JADE, IEEE TEC 13 (2009)

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/base/random_stream.hpp"
#include "engine/fit/optim/objective.hpp"

namespace torquescope {

enum class BoundRepair { midpoint, clip, reflect, random };

// in the order of the enum: what an option takes
std::vector<std::string> const& bound_repair_words();

// mirrored at the bounds until inside
double reflected(double x, double lower, double upper);

// a parameter x outside lower .. upper
double repaired(BoundRepair repair, double x, double lower, double upper, double target, RandomStream& random);

inline void repair_bounds(BoundRepair repair, Bounds const& bounds, std::span<double const> target,
                          RandomStream& random, std::span<double> trial) {
  TORQUESCOPE_EXPECT(trial.size() == bounds.dimension() && target.size() == trial.size());
  for (std::size_t j = 0; j < trial.size(); ++j) {
    double const lower = bounds.lower[j];
    double const upper = bounds.upper[j];
    if (trial[j] >= lower && trial[j] <= upper) continue;
    trial[j] = repaired(repair, trial[j], lower, upper, target[j], random);
    TORQUESCOPE_ENSURE(trial[j] >= lower && trial[j] <= upper);
  }
}

}  // namespace torquescope
