#pragma once
// The [recording] sections of a drafted job: files, units, rate and columns, as they were guessed.
//
// Threads    free functions

#include <filesystem>
#include <string>
#include <vector>

#include "engine/workflows/drafts/draft_text.hpp"
#include "engine/workflows/drafts/recording_guess.hpp"

namespace torquescope {

// warnings: what a person has to write, appended
void draft_recording_sections(RecordingGuess const& train, std::vector<RecordingGuess> const& others,
                              std::filesystem::path const& job_file, DraftText& text,
                              std::vector<std::string>& warnings);

// of [[recordings]] of servos (servo_draft.hpp): what all of them share, without files and torque
void draft_shared_recording(RecordingGuess const& one, std::filesystem::path const& job_file, DraftText& text,
                            std::vector<std::string>& warnings);

// as a job writes it: relative to the job's folder, unless it is absolute
std::string path_from(std::filesystem::path const& job_file, std::filesystem::path const& recording);

}  // namespace torquescope
