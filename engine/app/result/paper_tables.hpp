#pragma once
// Tables 3 and 4 of the study a job follows, beside ours; "" when the job follows none.
//
// Source     the fuzzy adaptive differential evolution study of the CRS A465 joint (2014), Tables 3 and 4, as printed

#include <string>

#include "engine/app/result/result_summary.hpp"
#include "engine/app/terminal/colour.hpp"

namespace torquescope {

std::string paper_tables(ResultSummary const& summary, Ink const& ink);

}  // namespace torquescope
