#pragma once
// What the drafts of jobs share beside their text: a name, and why a job does not run as it stands.
//
// Threads    functions of their arguments

#include <filesystem>
#include <string>

#include "engine/workflows/drafts/job_draft.hpp"

namespace torquescope {

// "Monday_3" of "logs/Monday 3.csv.gz"
std::string draft_name(std::filesystem::path const& file);

// a warning and an exit code; the first one's stays
void does_not_run(JobDraft& draft, ExitCode code, std::string const& why);
void does_not_run(JobDraft& draft, Error const& refused);

inline constexpr char const* what_to_edit = "write what stands behind EDIT";

}  // namespace torquescope
