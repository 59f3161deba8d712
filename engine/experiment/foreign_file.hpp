#pragma once
// A file of another kind than the command wants: a recording or a result given as a job, a job given as a recording.
//
// Errors     what says so, with the command that wants such a file: 78 for a job, 65 for a recording. A file that may
//            as well be a bad one of the right kind keeps its own error
// Threads    one at a time: a result is HDF5 (result_reader.hpp)

#include <filesystem>

#include "engine/experiment/job/job.hpp"

namespace torquescope {

// read_job(), and a word about what the file is where it is no job
Job read_job_file(std::filesystem::path const& path);

// a job, a result or nothing at all given to `torquescope init`: 65, 66
void refuse_no_recording(std::filesystem::path const& path);

}  // namespace torquescope
