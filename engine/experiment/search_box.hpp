#pragma once
// The box the population methods look in: [model.bounds] with "every = [-1, 1]" for all parameters, "inertia = [0, 2]"
// for one; without it a box that the recordings suggest.
//
// Default    of a parameter -b .. b, b the power of ten at or above three times the least squares value and its
//            standard error together: wide enough for every loss, and no hint where in it the optimum is
// Errors     problems are appended (78): unknown parameter, not two numbers, low not below high
// Threads    free functions

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/fit/optim/objective.hpp"

namespace torquescope {

// `bounds` may be nullptr: -1 .. 1 for every parameter, until default_box() is known
Bounds read_search_box(std::vector<std::string> const& parameter_names, Section const* bounds,
                       std::vector<Problem>& problems);

// values, errors: [R] of least squares
Bounds default_box(Eigen::VectorXd const& values, Eigen::VectorXd const& errors);

// "inertia -1 to 1, viscous -10 to 10"
std::string box_words(std::vector<std::string> const& parameter_names, Bounds const& box);

// names of the parameters that lie within a millionth of the box from one of its ends
std::vector<std::string> on_bounds(std::vector<std::string> const& parameter_names, Bounds const& box,
                                   Eigen::VectorXd const& parameters);

}  // namespace torquescope
