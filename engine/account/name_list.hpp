#pragma once
// Names of effects as people write them.
//
// Threads    pure functions

#include <cstddef>
#include <string>
#include <vector>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

// "speed drag" for speed_drag
std::string in_words(std::string name);
// "stribeck, cogging and speed drag"; last: "and" or "or"
std::string name_list(std::vector<std::string> const& names, std::string const& last);

std::vector<std::string> names_of(JointDiagnosis const& joint);
// of the catalogue's effects, how many were tried on this joint
std::ptrdiff_t n_tested(JointDiagnosis const& joint);

}  // namespace torquescope
