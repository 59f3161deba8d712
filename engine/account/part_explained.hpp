#pragma once
// How much of what is missing the accepted effects explain on held-out rows, and where the rest stands out: a clause.
//
// Wording    as sentences.hpp; a share that nobody measured is "a part"
// Threads    pure functions

#include <string>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

// "delay explains 71 % of what is missing on held-out rows; what is left stands out at loads between 0.95
// and 1.3 N m (9.0 % of the residual's energy)"
std::string part_explained_clause(JointDiagnosis const& joint);

}  // namespace torquescope
