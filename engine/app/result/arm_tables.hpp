#pragma once
// Errors of an arm, joint by joint, as people read them in a terminal.

#include <string>
#include <vector>

#include "engine/app/result/result_summary.hpp"
#include "engine/app/terminal/colour.hpp"

namespace torquescope {

// one line a joint, one for the arm, one for the arm over all rows; a column for each estimator, train and validation
// Requires   summary.arm
std::string joint_error_table(ResultSummary const& summary, Ink const& ink);

// a sentence of every joint of which the best fit leaves more than half; empty where there is no arm
std::vector<std::string> unexplained_joints(ResultSummary const& summary);

}  // namespace torquescope
