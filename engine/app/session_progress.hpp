#pragma once
// How the progress of a command is shown in its session: style, place, width and clock of this process.
//
// Threads    a thread of its own redraws the bar while nothing new is told

#include <memory>
#include <string>

#include "engine/app/session.hpp"
#include "engine/app/terminal/heartbeat.hpp"
#include "engine/app/terminal/progress.hpp"

namespace torquescope {

// `session` must outlive what is made of it
ProgressPrinter::Settings progress_settings(Session const& session);

class SessionProgress {
 public:
  explicit SessionProgress(Session const& session);
  // shown while it lives, when that is longer than a second: "read" of a large file
  SessionProgress(Session const& session, std::string const& stage);
  void operator()(ProgressUpdate const& update) { printer_(update); }

 private:
  ProgressPrinter printer_;
  std::unique_ptr<Heartbeat> heartbeat_;  // ends first; none when nothing is shown
};

}  // namespace torquescope
