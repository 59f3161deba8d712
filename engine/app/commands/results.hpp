#pragma once
// The tables of a result that a command has just made or found, and their JSON.

#include "engine/app/result/result_summary.hpp"
#include "engine/app/session.hpp"

namespace torquescope {

void print_results(Session const& session, ResultSummary const& summary);

}  // namespace torquescope
