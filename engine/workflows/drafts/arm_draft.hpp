#pragma once
// A job for a whole arm, drafted from recordings and a robot file: columns as patterns, "joint_states/{name}/position".
//
// Columns    those of the robot's first joint as `torquescope init` guesses them, with its name, its number from 1 or
//            from 0 as a mark; a pattern counts when the file has its column for every joint of the robot
// Text       as job_draft.hpp: a comment behind every guess, lines to edit, warnings
// Errors     66, 65 of the readers; those of read_robot()
// Threads    free functions

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/robot/robot_part.hpp"
#include "engine/workflows/drafts/job_draft.hpp"

namespace torquescope {

// part: of a robot with branches or a floating base, the arm that the recording is of
JobDraft draft_arm_job(std::vector<std::filesystem::path> const& recordings, std::filesystem::path const& robot,
                       std::filesystem::path const& job_file, RobotPart const& part = {});

// column: of the first joint; columns: all of the file. Nothing: no mark gives a column of every joint
std::optional<std::string> column_pattern(std::string const& column, std::vector<std::string> const& joint_names,
                                          std::vector<std::string> const& columns);

}  // namespace torquescope
