#pragma once
// What a search for effects of the whole arm found, as a diagnosis keeps it.
//
// Threads    free function

#include <string>
#include <vector>

#include "engine/diagnose/arms/whole_arm_search.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

// names, in the order of the question
struct WholeArmRecordings {
  std::vector<std::string> train{}, validation{};
};

// answers: of one search after the other, each beside what those before had found
WholeArmDiagnosis account_for_whole_arm(std::vector<WholeArmAnswer> const& answers,
                                        WholeArmRecordings const& recordings, double alpha);

// A joint of whose mismatch an effect of the whole arm explains more than `most` is not unexplained: what is left is
void credit_effects_of_whole_arm(std::vector<WholeArmAnswer> const& answers, double most,
                                 std::vector<JointDiagnosis>& joints);

}  // namespace torquescope
