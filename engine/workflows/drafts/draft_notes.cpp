#include "engine/workflows/drafts/draft_notes.hpp"

#include <cctype>

#include "engine/workflows/drafts/name_fields.hpp"

namespace torquescope {

std::string draft_name(std::filesystem::path const& file) {
  std::string name = file.filename().string();
  name = name.substr(0, begin_of_ending(name));
  for (char& letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0 && letter != '-') letter = '_';
  return name.empty() ? "recording" : name;
}

void does_not_run(JobDraft& draft, ExitCode code, std::string const& why) {
  if (draft.code == ExitCode::ok) draft.code = code;
  draft.warnings.push_back("this job does not run yet: " + why);
}

void does_not_run(JobDraft& draft, Error const& refused) {
  for (auto const& problem : refused.problems()) {
    auto const code = problem.code == ExitCode::bad_job ? ExitCode::bad_job : ExitCode::bad_data;
    does_not_run(draft, code, problem.what + (problem.help.empty() ? "" : "; " + problem.help));
  }
}

}  // namespace torquescope
