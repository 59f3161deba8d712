#pragma once
// The mismatch map of a diagnosis in a terminal: one line for each axis on which something was located.
//
// Sparkline  16 places along an axis, each the strongest |z| of its cells; blank where nothing was recorded
// Errors     none; names are made printable, no line is wider than the page
// Threads    pure functions

#include <string>

#include "engine/workflows/workflows.hpp"

namespace torquescope {

// "where": of the baseline, the axis with most energy first; "" for a joint without a map
std::string where_text(JointDiagnosis const& joint, bool utf8);
// "left": with the accepted effects in the model, the axes of what stays unexplained; "" where nothing is
std::string what_is_left_text(JointDiagnosis const& joint, bool utf8);

}  // namespace torquescope
