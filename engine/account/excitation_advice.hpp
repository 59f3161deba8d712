#pragma once
// Which motion would tell apart what this recording cannot.
//
// For        every accepted effect with equivalent ones: the experiment that separates it, as its own file says
//            (EffectDescription::separated_by), and theirs. Where nothing may be named: for what came closest
// Threads    free function

#include <string>
#include <vector>

#include "engine/infer/verdict/diagnosis.hpp"

namespace torquescope {

std::vector<ExcitationAdvice> advice_for(std::vector<NamedEffect> const& effects);

// the candidate that predicts most of what it was not fitted to; none where none predicts anything
std::vector<std::string> closest_of(std::vector<Candidate> const& candidates);
std::vector<ExcitationAdvice> advice_to_confirm(std::vector<std::string> const& names);

}  // namespace torquescope
