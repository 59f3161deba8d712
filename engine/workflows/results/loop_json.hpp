#pragma once
// What simulations in the loop found out, as JSON: the same of one joint and of many recordings.
//
// Threads    pure function

#include <nlohmann/json_fwd.hpp>

#include "engine/infer/verdict/decision_account.hpp"

namespace torquescope {

nlohmann::ordered_json loop_json(DecisionAccount::Loop const& loop);

}  // namespace torquescope
