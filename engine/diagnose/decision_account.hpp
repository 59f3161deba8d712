#pragma once
// Facts of a decision as a result holds them.
//
// Threads    pure function

#include "engine/decision/decision_facts.hpp"
#include "engine/verdict/decision_account.hpp"

namespace torquescope {

DecisionAccount account_of(DecisionFacts const& facts, std::string verdict);

}  // namespace torquescope
