#pragma once
// The candidates of a diagnosis in a terminal: what was weighed, how strong it is, what became of it and why.
//
// Why        a number behind the decision points to a line below the table: many share a reason, and none fits into a
//            column
// CV gain    a share of the mismatch; above 1 "> 100 %" (the model alone may predict other blocks worse than nothing
//            does), below 0 "none"
// Errors     none; names are made printable, no line is wider than the page
// Threads    pure functions

#include <string>

#include "engine/workflows/workflows.hpp"

namespace torquescope {

// "" for a joint without candidates; ends in a line feed
std::string candidates_text(JointDiagnosis const& joint);

// "28.4 %", "> 100 %", "none"; "" when it was not measured
std::string cv_gain_cell(double share);

}  // namespace torquescope
