#pragma once
// Problems as a person reads them and as a program reads them: what, where, the line with a caret, facts, what to
// write.
//
//     error: unknown key "cutof_hz" in [filter]                              [78]
//       --> jobs/lab.toml:14:1
//     14 | cutof_hz = 25
//        | ^^^^^^^^ did you mean "cutoff_hz"?
//       help: ...
//
// Width      page_width(); a longer source line is cut around its caret
// Limit      20 problems at most, then their count

#include <string>
#include <vector>

#include "engine/app/terminal/colour.hpp"
#include "engine/base/error.hpp"

namespace torquescope {

std::string error_text(std::vector<Problem> const& problems, Ink const& ink);

// {"schema":1,"error":{first problem},"errors":[all of them]}; absent facts are null
std::string error_json(std::vector<Problem> const& problems);

}  // namespace torquescope
