#pragma once
// Writes what only results of arms have: /robot, /arm, rows joint by joint, errors joint by joint (RESULT_FORMAT.md).
//
// Errors     those of ResultWriter

#include <string>

#include "engine/experiment/experiment_parts.hpp"
#include "engine/experiment/runs/run_summary.hpp"
#include "engine/store/result_writer.hpp"

namespace torquescope {

// /robot and /arm
void write_arm(ResultWriter& writer, Experiment::Parts const& parts);

// GROUP/joint_1, ...: moving rows; only their count where the job wants no samples
void write_arm_samples(ResultWriter& writer, std::string const& group, DataSet const& set,
                       Experiment::Parts const& parts);

// of the median run of an estimator, into /runs/LABEL
void write_arm_accuracy(ResultWriter& writer, std::string const& label, Experiment::Parts const& parts,
                        RunResults const& results);

}  // namespace torquescope
