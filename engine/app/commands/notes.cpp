#include "engine/app/commands/notes.hpp"

#include <fmt/format.h>

#include "engine/app/session_progress.hpp"
#include "engine/app/terminal/plain_text.hpp"

namespace torquescope {

Experiment load_with_bar(Session const& session, std::filesystem::path const& job, Experiment::Purpose purpose) {
  SessionProgress const bar(session, "read");
  return Experiment::load(job, purpose);
}

void note_start(Session const& session, std::string const& job_line, Experiment const& experiment,
                ThreadChoice const& threads) {
  session.note(session.topic_line("job", job_line));
  session.note(session.topic_line("data", experiment.data_line()));
  session.note(session.topic_line("threads", fmt::format("{} ({}), {}, seed {}", threads.count, threads.reason,
                                                         vector_target(), experiment.seed())));
  if (!threads.warning.empty()) session.note(session.topic_line("warning", threads.warning));
  for (auto const& warning : experiment.warnings()) session.note(session.topic_line("warning", warning));
  for (auto const& remark : experiment.remarks()) session.note(session.topic_line("remark", remark));
}

void note_whereabouts(Session const& session, std::string const& word, std::filesystem::path const& file,
                      std::string const& json) {
  Ink const& ink = session.note_ink();
  std::string const name = ink.name(printable(file.string()));
  std::string line = fmt::format("{}{}  {}", pad_right(word, 7), name, bytes_text(std::filesystem::file_size(file)));
  if (!json.empty() && json != "-") line += ", " + ink.name(printable(json));
  session.note(line + "\n");
  session.note(fmt::format("look   torquescope report {}\n", name));
}

void tidy_up(Session const& session, std::filesystem::path const& result, std::string const& inputs_sha256) {
  for (auto const& warning : remove_segments(result, inputs_sha256))
    session.note(session.topic_line("warning", warning));
}

}  // namespace torquescope
