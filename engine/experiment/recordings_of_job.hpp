#pragma once
// What the recordings of one job share: where they come from, a sampling rate, and who may see them.
//
// Threads    free functions

#include <string>
#include <vector>

#include "engine/data/recorded_tables.hpp"
#include "engine/data/recording.hpp"
#include "engine/experiment/job/job.hpp"

namespace torquescope {

// the table in memory of this name, else that of the file beside the job; Errors: those of read_table()
RawTable table_of_job(Job const& job, std::string const& name, Section const& section, RecordedTables const& tables);

// of a column that only some recordings need, one has it: else its name is wrong (Error 78)
void require_inputs(Job const& job, RecordingOptions const& options, std::vector<Recording> const& train,
                    std::vector<Recording> const& validation);

// that of the first where all are about the same, else the lowest
double rate_of_job(std::vector<Recording> const& train, std::vector<Recording> const& validate);
// what is resampled says so in its warnings
void bring_to_rate(std::vector<Recording>& recordings, double rate_hz);
// of one file: they have one clock, so that the first alone says it
void bring_joints_to_rate(std::vector<Recording>& joints, double rate_hz);

// keeps the first `share` of every training recording; the rest goes behind `validation`. A share of 1 changes nothing
void split_off_validation(std::vector<Recording>& train, std::vector<Recording>& validation, double share);

}  // namespace torquescope
