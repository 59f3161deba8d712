#pragma once
// Which joint of a recording somebody means: by its number, or by its name.
//
// Name       what stands before the last '/' of its position column ("elbow" of "joint_states/elbow/position"), else
//            that column's whole name
// Errors     64 when the file has no such joint, with those it has; 66, 65 of the readers
// Threads    free functions

#include <filesystem>
#include <string>
#include <vector>

namespace torquescope {

std::string joint_name(std::string const& position_column);

// from 1, as guess_columns() takes it; "" gives 0, the first of the file
std::size_t joint_number(std::filesystem::path const& recording, std::string const& joint);

}  // namespace torquescope
