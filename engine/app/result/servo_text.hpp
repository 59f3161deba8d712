#pragma once
// What the terminal shows of a diagnosis of many recordings.
//
// Threads    pure functions

#include <string>

#include "engine/app/terminal/colour.hpp"
#include "engine/workflows/servo_report.hpp"

namespace torquescope {

std::string servo_verdict_text(ServoReport const& report, Ink const& ink);  // a line and the errors
std::string servo_text(ServoReport const& report, bool all);

}  // namespace torquescope
