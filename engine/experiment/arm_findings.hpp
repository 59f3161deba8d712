#pragma once
// What an arm's training rows say before any estimator: which parameters they can tell, and which of the fitted ones no
// arm can have.
//
// Told       alone, within a group, not at all (statistics/gram_identifiability.hpp), and which joint should move more
// Negative   frictions and drive inertias by passive_signs(): a warning. M_jj(q) of a joint along the motion: a fault.
//            Surely: data/levels.hpp, in HAC standard errors; M(q) is linear in the parameters
// Threads    free functions
// Source     M(q) positive definite of anything that moves: Khalil and Dombre 2002, section 9.3

#include <string>
#include <vector>

#include "engine/experiment/experiment_parts.hpp"
#include "engine/fit/statistics/gram_identifiability.hpp"

namespace torquescope {

struct ArmIdentifiability {
  std::vector<Seen> seen;  // [R]
  bool all_seen = true;    // each alone
  std::string words;       // "47 parameters: 45 alone, 2 only in a group (...), none unseen"
};
std::string word(Seen seen);  // "alone", "group", "no"
ArmIdentifiability arm_identifiability(Experiment::Parts const& parts);

// needs parts.reductions and the motion of the rows
std::vector<Finding> arm_findings(Experiment::Parts const& parts, RecordingOptions const& options);

}  // namespace torquescope
