#pragma once
// Why names that would explain the training recording are not given: clauses of a sentence.
//
// Wording    as sentences.hpp
// Threads    pure functions

#include <string>
#include <vector>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

// because the joint is one of a moving arm: a sentence. Columns: of the joints that load it; relerr: with their motion
std::string other_joints_sentence(JointDiagnosis const& joint, std::vector<std::string> const& columns, double relerr);

}  // namespace torquescope
