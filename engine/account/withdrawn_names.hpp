#pragma once
// Why names that would explain the training recording are not given: clauses of a sentence.
//
// Wording    as sentences.hpp
// Threads    pure functions

#include <string>
#include <vector>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

// because of validation recordings: "backlash, which would explain it, takes the validation error from
// 2.2 % to 2.5 %, where replicates with it promise 1.6 %", or "and a joint simulated with it no longer follows the
// reference"
std::string refutation_clause(JointDiagnosis const& joint, bool twins_ran_away);
// because hardly anything is won: "cogging takes the validation error from 2.22 % to 2.14 %: too little ..."
std::string too_small_clause(JointDiagnosis const& joint);
// because the joint is one of a moving arm: a sentence. Columns: of the joints that load it; relerr: with their motion
std::string other_joints_sentence(JointDiagnosis const& joint, std::vector<std::string> const& columns, double relerr);
// because of what they leave: "backlash, the closest of 29 known effects, explains 37 % of what is missing". Share: 0
// to 1
std::string too_little_clause(JointDiagnosis const& joint, double share);

}  // namespace torquescope
