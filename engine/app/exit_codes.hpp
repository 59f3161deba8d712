#pragma once
// What every exit code means, in the words of the help page, the man pages and jobs/README.md; and the code of a
// verdict, where --exit-code asks for it.
//
// Stable     scripts depend on these numbers; the verdicts' keep clear of 64 to 78 (sysexits.h), of a shell's own
//            (1, 2, 126 and above) and of one another, but for the two that blame the recording

#include <span>

#include "engine/base/error.hpp"

namespace torquescope {

enum class Verdict;  // verdict/diagnosis.hpp

struct ExitCodeMeaning {
  ExitCode code;
  char const* words;
};

std::span<ExitCodeMeaning const> exit_codes();     // of every command
std::span<ExitCodeMeaning const> verdict_codes();  // with --exit-code
ExitCode code_of(Verdict verdict);

}  // namespace torquescope
