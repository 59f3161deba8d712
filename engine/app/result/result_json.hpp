#pragma once
// A result file as one stable JSON document: {"schema":1, ...}; keys never change their meaning within a schema.
//
// Numbers    unrounded; absent ones are null

#include <string>

#include "engine/app/result/result_summary.hpp"

namespace torquescope {

std::string result_json(ResultSummary const& summary);

}  // namespace torquescope
