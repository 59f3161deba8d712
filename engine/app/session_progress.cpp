#include "engine/app/session_progress.hpp"

#include <unistd.h>

#include <chrono>

#include "engine/app/terminal/environment.hpp"

namespace torquescope {

ProgressPrinter::Settings progress_settings(Session const& session) {
  ProgressPrinter::Settings settings;
  settings.style = progress_style(session.options().progress, progress_facts(session.options().quiet));
  settings.write = [&session](std::string const& text) { session.note(text); };
  settings.width = [] { return terminal_width(STDERR_FILENO); };
  settings.clock = [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  };
  settings.utf8 = session.utf8();
  settings.patient = session.options().progress == ProgressChoice::automatic;
  return settings;
}

SessionProgress::SessionProgress(Session const& session) : printer_(progress_settings(session)) {
  constexpr std::chrono::milliseconds period(250);
  if (progress_settings(session).style != ProgressStyle::none)
    heartbeat_ = std::make_unique<Heartbeat>(period, [this] { printer_.beat(); });
}

SessionProgress::SessionProgress(Session const& session, std::string const& stage) : SessionProgress(session) {
  printer_.wait_for(stage);
}

}  // namespace torquescope
