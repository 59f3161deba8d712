#pragma once
// Terms of a model that are one and the same number on the rows of a recording: constants in one direction of motion.
//
// Why        while a joint moves one way on all rows that count, Coulomb friction is an offset. Two of them cannot be
//            fitted; one of them can, and stands for all
// Rule       of the terms whose columns are constant on the rows one is kept: dry friction, unless it would be less
//            than none; the others are dropped. At one speed a term of the velocity is one with dry friction, and goes
// Threads    free function

#include <string>
#include <vector>

#include "engine/infer/pipeline/record_pipeline.hpp"

namespace torquescope {

// names of the terms to drop; none where at most one is constant. has_one_speed: motion_limits.hpp
std::vector<std::string> terms_to_drop(Regressor const& regressor, ProcessedRecord const& prepared,
                                       bool has_one_speed = false);

}  // namespace torquescope
