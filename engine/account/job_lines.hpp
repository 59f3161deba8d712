#pragma once
// Lines of a job that hold what was named at a joint of an arm, so that `run` fits it and `export` writes it.
//
// Threads    pure function

#include <string>
#include <vector>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

// "[[model.effects]]", "joint = 2", "name = ...", its shapes; nothing of effects that no job of an arm can hold
std::vector<std::vector<std::string>> job_lines(JointDiagnosis const& joint);

}  // namespace torquescope
