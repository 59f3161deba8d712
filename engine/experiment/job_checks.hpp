#pragma once
// What a job is refused for: by its text alone, by its recordings, or by what they leave of its estimators.
//
// Errors     problems are appended (78) unless a function says that it throws
// Threads    free functions

#include <string>
#include <vector>

#include "engine/experiment/experiment_parts.hpp"

namespace torquescope {

// a job must have something to do
void check_work(Job const& job, Experiment::Purpose purpose, std::vector<Problem>& problems);

// a name becomes that of a file
void check_name(Job const& job, std::string const& name, std::vector<Problem>& problems);

// [output] history
void check_history(Job const& job, OutputOptions const& output, std::vector<Problem>& problems);

// where its data come from: exactly one of files, a set of them, or a simulation
void check_sources(Job const& job, RecordingOptions const& recording, Experiment::Purpose purpose,
                   std::vector<Problem>& problems);

// the largest values that the options allow one by one overflow 64 bits together; doubles do not
void check_sizes(Experiment::Parts const& parts, std::vector<Problem>& problems);

// float32 where its rounding would decide between candidates is refused, at the line that asks for it; throws (78)
void check_precision(Experiment::Parts& parts);

// throws (65): faults end a fit; a check lists them, and a diagnosis has a verdict for them
void refuse_faults(Experiment::Parts const& parts, Job const& job, RecordingOptions const& options);

// an arm is not simulated joint by joint
void refuse_rollouts_of_arm(Experiment::Parts const& parts, std::vector<Problem>& problems);

}  // namespace torquescope
