#pragma once
// A recording of an arm: one Recording per joint, all on one clock.
//
// Columns    channel = "q{j}_rad" of a job stands for one column per joint: {j} is its number from 1, {i} from 0,
//            {name} what the robot file calls it; time alone has one column for all
// Errors     joint_options: Error 78, all problems at once: no such mark in a channel, a wrong number of
//            torque_per_unit
// Threads    plain record; free functions

#include <string>
#include <vector>

#include "engine/data/recording_reader.hpp"

namespace torquescope {

struct ArmRecording {
  std::string name;               // file name without its folder
  std::string sha256;             // of the file
  std::vector<Recording> joints;  // from the base to the tip; equal times
};

// the options of each joint alone; joint_names: of the robot file, from the base to the tip
std::vector<RecordingOptions> joint_options(RecordingOptions const& arm, std::vector<std::string> const& joint_names,
                                            Section const& section);

// "joint 2 (shoulder_lift)"; a name that says the number already stands alone: "joint2"
std::string joint_title(std::size_t joint, std::vector<std::string> const& joint_names);

}  // namespace torquescope
