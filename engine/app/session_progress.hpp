#pragma once
// How the progress of a command is shown in its session: style, place, width and clock of this process.

#include "engine/app/session.hpp"
#include "engine/app/terminal/progress.hpp"

namespace torquescope {

// `session` must outlive what is made of it
ProgressPrinter::Settings progress_settings(Session const& session);

}  // namespace torquescope
