#pragma once
// What a diagnosis of an arm says in one paragraph: which joints lack what, and the error over all joints.
//
// Threads    pure functions

#include <string>
#include <vector>

#include "engine/verdict/diagnosis.hpp"

namespace torquescope {

// "Named at joint 2 (load dependent friction) and joint 3 (stribeck); unexplained at joint 1; nothing missing at joints
// 4, 5 and 6. Unseen relerr over all joints 4.5 % to 2.1 %."
std::string arm_reason_sentence(Diagnosis const& diagnosis);

// "tuesday.csv has too few rows of this joint moving one way to judge it."
std::string too_few_rows_sentence(std::vector<std::string> const& recordings);

}  // namespace torquescope
