#pragma once
// A finding in words: its code, what was found, what was done, and the line to paste into the job. The only place that
// knows the sentences of engine/data/health.
//
// Threads    functions of their arguments

#include <string>

#include "engine/base/error.hpp"
#include "engine/data/recording.hpp"

namespace torquescope {

std::string code_of(FindingKind kind);  // "position_wraps": stable, for programs
std::string grade_word(Grade grade);    // "note", "warning", "fault"
std::string sentence_of(Finding const& finding);
// with the cure behind it, where there is one
std::string sentence_with_cure(Finding const& finding);
std::string cure_of(Finding const& finding);  // a line of [recording], or what to do; may be empty

// a fault as a Problem (exit code 65) at the first of its lines
Problem problem_of(Finding const& finding, std::string const& path);

bool is_fault(Finding const& finding);

}  // namespace torquescope
