#pragma once
// A replay as the terminal shows it: a table of errors over all samples, and what to know beside it.

#include <string>

#include "engine/app/terminal/colour.hpp"
#include "engine/workflows/replay_workflow.hpp"

namespace torquescope {

std::string replay_text(Replay const& replay, Ink const& ink);

}  // namespace torquescope
