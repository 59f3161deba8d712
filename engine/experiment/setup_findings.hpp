#pragma once
// What a recording of an arm says of its own set-up, before any physics: signs, order, zeros, units, gravity, limits.
//
// Grade      a fault where the change alone halves what the fit leaves: numbers and verdicts would be wrong. A warning
//            where the robot file alone tells it, and where positions lie beyond its limits. A diagnosis would find
//            physics for such a set-up: there it is a fault where the file's masses, set up so, explain the torque
// Moments    where nothing is wrong with the set-up, when something pushes the last link (arms/tip_touch.hpp; of a
//            diagnosis those rows are left out), or the instant at which the links become others, as a warning
// Line       in line_to_write: keys of [recording] and [model] with all numbers of the arm, ready to be pasted
// Threads    free function
// Source     arms/setup_search.hpp

#include <string>
#include <vector>

#include "engine/experiment/experiment_parts.hpp"

namespace torquescope {

// empty where the recording has a payload throughout, or the set-up is as it should be
enum class SetupUse { fit, diagnosis };
std::vector<Finding> setup_findings(Experiment::Parts& parts, RecordingOptions const& options, SetupUse use);

// what the job is to say so that its columns are taken as in this set-up, a key a line, three blanks between them; keys
// that do not change are left out. chain: as it is read now. otherwise: "modified_dh", of the other convention
std::string setup_lines(ArmSetup const& setup, SerialChain const& chain, RecordingOptions const& options,
                        std::string const& otherwise);

}  // namespace torquescope
