#pragma once
// What a search for laws of the whole arm found, as a diagnosis keeps it.
//
// Threads    free function

#include <string>
#include <vector>

#include "engine/arms/whole_arm_search.hpp"
#include "engine/verdict/diagnosis.hpp"

namespace torquescope {

// answers: of one search after the other, each beside what those before had found; recordings: names of training
WholeArmDiagnosis account_for_whole_arm(std::vector<WholeArmAnswer> const& answers,
                                        std::vector<std::string> const& recordings, double alpha);

}  // namespace torquescope
