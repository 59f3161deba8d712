#pragma once
// Facts of a decision as a result holds them.
//
// Threads    pure function

#include "engine/infer/all_rows/decision_facts.hpp"
#include "engine/infer/all_rows/loop_facts.hpp"
#include "engine/infer/verdict/decision_account.hpp"

namespace torquescope {

DecisionAccount account_of(DecisionFacts const& facts, std::string verdict);
DecisionAccount::Loop account_of(LoopFacts const& facts);

}  // namespace torquescope
