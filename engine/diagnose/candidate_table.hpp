#pragma once
// The candidates as the diagnosis lists them: the step at which nothing was named yet, and what became of each.
//
// Order      by what they explain of the mismatch; without a mismatch by how far they are beyond chance
// Threads    free functions

#include <string>
#include <vector>

#include "engine/diagnose/diagnosis.hpp"
#include "engine/diagnose/forward_selection.hpp"

namespace torquescope {

std::vector<Candidate> candidate_table(Selection const& selection);

// those that some named effect could be as well
void mark_equivalent(std::vector<Candidate>& candidates, std::vector<NamedEffect> const& effects);

// nothing that was named stands
void withdraw_names(std::vector<Candidate>& candidates, std::string const& reason);

}  // namespace torquescope
