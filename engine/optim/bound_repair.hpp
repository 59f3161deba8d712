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

#include <span>
#include <string>
#include <vector>

#include "engine/base/random_stream.hpp"
#include "engine/optim/objective.hpp"

namespace torquescope {

enum class BoundRepair { midpoint, clip, reflect, random };

// in the order of the enum: what an option takes
std::vector<std::string> const& bound_repair_words();

void repair_bounds(BoundRepair repair, Bounds const& bounds, std::span<double const> target, RandomStream& random,
                   std::span<double> trial);

}  // namespace torquescope
