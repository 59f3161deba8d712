#pragma once
// The [recording] sections of a drafted job: files, units, rate and columns, as they were guessed.
//
// Threads    free function

#include <filesystem>
#include <string>
#include <vector>

#include "engine/run/draft_text.hpp"
#include "engine/run/recording_guess.hpp"

namespace torquescope {

// warnings: what a person has to write, appended
void draft_recording_sections(RecordingGuess const& train, std::vector<RecordingGuess> const& others,
                              std::filesystem::path const& job_file, DraftText& text,
                              std::vector<std::string>& warnings);

}  // namespace torquescope
