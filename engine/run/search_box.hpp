#pragma once
// The box the population methods look in: [model.bounds] with "every = [-1, 1]" for all parameters, "inertia = [0, 2]"
// for one.
//
// Errors     problems are appended (78): unknown parameter, not two numbers, low not below high

#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/optim/objective.hpp"

namespace torquescope {

// `bounds` may be nullptr: -1 .. 1 for every parameter
Bounds read_search_box(std::vector<std::string> const& parameter_names, Section const* bounds,
                       std::vector<Problem>& problems);

}  // namespace torquescope
