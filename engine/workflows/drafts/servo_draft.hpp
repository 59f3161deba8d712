#pragma once
// A job of many recordings of a servo, drafted: [[recordings]] by the names of the files, [known] by what they tell.
//
// Errors     none of the files: what the job would be refused for stands in JobDraft::warnings, with its code
// Threads    free function

#include <filesystem>
#include <vector>

#include "engine/workflows/drafts/job_draft.hpp"
#include "engine/workflows/drafts/recording_guess.hpp"

namespace torquescope {

// first: whose columns all of them have; others that cannot be read as it is are left out
JobDraft draft_servo_job(RecordingGuess const& first, std::vector<RecordingGuess> const& others,
                         std::filesystem::path const& job_file);

}  // namespace torquescope
