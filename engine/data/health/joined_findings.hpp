#pragma once
// One finding for what several joints of an arm have alike: kind, grade, repair and cure.
//
// Stands     the one with most rows, then of the largest size; the others are in Finding::likewise, in their order
// Threads    free function

#include <vector>

#include "engine/data/finding.hpp"

namespace torquescope {

// findings: of the joints of one recording, from the base to the tip; those of the whole recording stay as they are
std::vector<Finding> joined_findings(std::vector<Finding> const& findings);

}  // namespace torquescope
