#pragma once
// Single rows that stand out from both neighbours, too little to be called wrong: a fit may say that one of them
// matters (problem/row_influence.hpp).
//
// Equation   e_i = distance of x_i from the interval between x_(i-1) and x_(i+1): a step of the friction has none.
//            e_i >= 3 times all bends |x_(j-1) - 2 x_j + x_(j+1)| within 25 rows but those of i and beside it, and at
//            least 4 steps of the signal's quantisation. More than thirty are none: so is the signal
// Shapes     values: one per row; NaN is skipped
// Threads    free functions

#include <cstddef>
#include <vector>

#include "engine/data/health/examination.hpp"

namespace torquescope {

std::vector<std::size_t> lone_rows(std::vector<double> const& values);

// of position and torque, the times as in the file
std::vector<LoneRow> find_lone_rows(Examination& exam);

}  // namespace torquescope
