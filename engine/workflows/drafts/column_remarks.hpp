#pragma once
// What `torquescope init` says of columns: which belong together, what they look like, why one is not used.
//
// Threads    functions of their arguments

#include <string>

#include "engine/workflows/drafts/recording_guess.hpp"

namespace torquescope {

// "joints are counted from different numbers: "tau1" belongs to "q0""
std::string shift_words(NumberShift const& shift);

// why the joint that nobody asked for is not the first, or ""
std::string passed_over_words(ColumnGuess const& columns);

// why a column that looks like the reference is none, or ""
std::string unused_reference_words(RecordingGuess const& guess);

// "b": -0.71 to 0.83, smooth: a position?
std::string look_words(ColumnLook const& look);

}  // namespace torquescope
