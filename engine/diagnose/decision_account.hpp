#pragma once
// Facts of a decision as a result holds them.
//
// Threads    pure function

#include "engine/infer/decision/decision_facts.hpp"
#include "engine/infer/decision/decision_numbers.hpp"
#include "engine/infer/decision/loop_facts.hpp"
#include "engine/infer/verdict/decision_account.hpp"

namespace torquescope {

DecisionAccount account_of(DecisionFacts const& facts, DecisionNumbers const& numbers, std::string verdict);
DecisionAccount::Loop account_of(LoopFacts const& facts);

}  // namespace torquescope
