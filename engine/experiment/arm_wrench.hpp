#pragma once
// A wrench at the tip that a job names columns of (recording.wrench), as torque of the joints.
//
// Columns    on the clock of the arm; where one of them has no value, no joint has a row
// Errors     Problems (78): not six columns, keys without them, beside methods that need the motors' own torque.
//            read_wrench: 78, a column that is not in the file; those of make_recording()
// Threads    free functions

#include <string>
#include <vector>

#include "engine/data/recording_reader.hpp"
#include "engine/experiment/experiment_parts.hpp"
#include "engine/fit/problem/recorded_arm.hpp"
#include "engine/robot/serial_chain.hpp"

namespace torquescope {

void check_wrench(Job const& job, RecordingOptions const& options, std::vector<EstimatorPlan> const& plans,
                  bool has_drive_gains, std::vector<Problem>& problems);

// six recordings of the file's columns, or none; joint: the options of the arm's first joint
std::vector<Recording> read_wrench(RawTable const& table, RecordingOptions const& joint, Section const& section);

// into what each joint's torque is, and out of RecordedArm::wrench
void add_wrench(RecordedArm& arm, SerialChain const& chain, RecordingOptions const& options);

// what the wrench explains of the torque on held-out blocks; no words: the job has none
struct WrenchAccount {
  bool explains = true;
  std::string words{};
};
WrenchAccount wrench_account(Experiment::Parts const& parts);

// frame or side of the wrench that is not as the job says; empty: as it should be, or there is none
std::vector<Finding> wrench_findings(Experiment::Parts const& parts, RecordingOptions const& options);

}  // namespace torquescope
