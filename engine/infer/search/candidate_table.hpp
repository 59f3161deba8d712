#pragma once
// The candidates as the diagnosis lists them: the step at which nothing was named yet, and what became of each.
//
// Order      by what they explain of the mismatch; without a mismatch by how far they are beyond chance. Names that are
//            withdrawn come first: refined in shape they explained most, and they are what a verdict speaks of
// Reason     of every one but what is named: what the search said of it last (Selection::rejected), else what is known
//            of it from the first step
// Threads    free functions

#include <string>
#include <vector>

#include "engine/infer/search/selection.hpp"
#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

// q: level above which one is within chance; blocked_excess: of the baseline (blocked_mismatch.hpp)
std::vector<Candidate> candidate_table(Selection const& selection, double q, double blocked_excess);

// those that some named effect could be as well
void mark_equivalent(std::vector<Candidate>& candidates, std::vector<NamedEffect> const& effects);

// nothing that was named stands
void withdraw_names(std::vector<Candidate>& candidates, std::string const& reason);

}  // namespace torquescope
