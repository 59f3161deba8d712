#pragma once
// A job file for recordings that nobody has described yet: what is guessed, how sure that is, what a person must say.
//
// Text       TOML with a comment behind every guess; what cannot be guessed is a commented line to edit and a warning
// Paths      relative to the folder of `job_file`; absolute ones stay
// Errors     66, 65 of the readers; 64 when the file has no such joint
// Threads    free function

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/data/column_guess.hpp"

namespace torquescope {

struct JobDraft {
  std::string text;
  std::vector<std::string> guesses{};   // one line each: columns, rate, filter
  std::vector<std::string> looks{};     // where columns have to be named: what each looks like
  std::vector<std::string> warnings{};  // what to edit, and what `torquescope check` would refuse
  ExitCode code = ExitCode::ok;         // else why it does not run as it stands: 65 the recording, 78 lines to edit
};

enum class DraftKind {
  of_the_files,  // one joint with a torque, or many recordings of a servo without one
  servo,         // the latter even where a column may be a torque
};

// recordings: of a joint the first with a position trains, the others validate. joint: from 1; 0 for the first of the
// file. named: columns that serve whatever their names say
JobDraft draft_job(std::vector<std::filesystem::path> const& recordings, std::filesystem::path const& job_file,
                   std::size_t joint = 0, DraftKind kind = DraftKind::of_the_files, ChosenColumns const& named = {});

}  // namespace torquescope
