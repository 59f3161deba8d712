#pragma once
// Which column of a file is likely meant for a channel: only ever a help in a message, never taken by itself.
//
// Threads    functions of their arguments

#include <string>
#include <vector>

namespace torquescope {

// the first column whose name begins like the channel is usually called ("q1_rad" for position), or ""
std::string likely_column(std::string const& channel, std::vector<std::string> const& names);

// what to write for a channel: `torque = "i_A" with torque_per_unit = <N m per A>`, or "" without a likely column
std::string mapping_advice(std::string const& channel, std::vector<std::string> const& names);

// `columns = {time = "t_s", position = "q_rad", torque = "<column>"}`
std::string columns_advice(std::vector<std::string> const& names);

}  // namespace torquescope
