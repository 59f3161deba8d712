#pragma once
// Which columns are likely meant for a channel, by their names: for the advice of messages and for `torquescope init`.
//
// Order      best first: by what the words of the name say and whether its unit fits (column_name.hpp)
// Threads    functions of their arguments

#include <string>
#include <vector>

#include "engine/data/column_name.hpp"

namespace torquescope {

struct LikelyColumn {
  std::string column;  // its name in the file
  ColumnName name;
  ColumnRole role;
};

// all that may serve as the channel: time, position, torque, reference, velocity, acceleration
// units: one per name, or none (RawTable::units)
std::vector<LikelyColumn> likely_columns(std::string const& channel, std::vector<std::string> const& names,
                                         std::vector<std::string> const& units = {});

// the best of them, or ""
std::string likely_column(std::string const& channel, std::vector<std::string> const& names);

// what to write for a channel: `torque = "i_A" with torque_per_unit = <N m per A>`, or "" without a likely column
std::string mapping_advice(std::string const& channel, std::vector<std::string> const& names);

// `columns = {time = "t_s", position = "q_rad", torque = "<column>"}`
std::string columns_advice(std::vector<std::string> const& names);

}  // namespace torquescope
