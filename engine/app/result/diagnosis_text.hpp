#pragma once
// A diagnosis as a page of at most 80 columns: the verdict, where the mismatch is, which effects were weighed, what to
// record next.
//
// Marks      one per verdict, a star where the terminal has no UTF-8; the word beside it says the same
// Sparkline  16 places along an axis, each the strongest |z| of its cells; blank where nothing was recorded
// Threads    pure functions

#include <string>

#include "engine/app/terminal/colour.hpp"
#include "engine/workflows/workflows.hpp"

namespace torquescope {

struct DiagnosisTextOptions {
  bool all_candidates = false;  // the reason in words, maps and every effect that was weighed; else what to record next
  bool utf8 = true;
};

// mark, word, what is missing with its numbers, errors over all samples: a few lines, which `--quiet` leaves
std::string verdict_text(Diagnosis const& diagnosis, bool utf8, Ink const& ink);
// with all_candidates where, what, why; else what to record next, or ""
std::string evidence_text(Diagnosis const& diagnosis, DiagnosisTextOptions const& options, Ink const& ink);
// both
std::string diagnosis_text(Diagnosis const& diagnosis, DiagnosisTextOptions const& options, Ink const& ink);

// parameters of every joint before and after, with 95 % intervals
std::string diagnosed_model_text(Diagnosis const& diagnosis, Ink const& ink);

}  // namespace torquescope
