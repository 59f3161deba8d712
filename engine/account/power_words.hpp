#pragma once
// What a diagnosis that finds nothing missing would have found, and what it could not: a sentence.
//
// Wording    as sentences.hpp
// Threads    pure function
// Source     engine/infer/decision/decision_verdict.hpp, smallest_named

#include <string>

#include "engine/infer/verdict/decision_account.hpp"

namespace torquescope {

// "A torque of 1.2 % of the whole that the model's terms do not take up would most likely have been named; friction
// that turns round within 5.0 mrad would not, because it counts as the model's own."; "" where nothing was asked
std::string power_sentence(DecisionAccount const& decision, std::string const& unit_position);

}  // namespace torquescope
