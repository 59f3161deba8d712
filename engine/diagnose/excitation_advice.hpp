#pragma once
// Which motion would tell apart what this recording cannot.
//
// For        every named effect with equivalent ones: the experiment that separates it, as its own file says
//            (EffectDescription::separated_by), and theirs
// Threads    free function
// Source     PHYSICS.md section 1, column "Sep."

#include <vector>

#include "engine/diagnose/diagnosis.hpp"

namespace torquescope {

std::vector<ExcitationAdvice> advice_for(std::vector<NamedEffect> const& effects);

}  // namespace torquescope
