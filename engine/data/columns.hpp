#pragma once
// Which column of a table serves as which channel, as recording.columns says. Nothing is guessed.
//
// Channels   time, position, torque, reference, velocity, acceleration, input_channels(), simulated_torque,
//            simulated_position
// Names      a column's whole name, or what stands behind its last '/' when no other column ends so
// Errors     Error 78 with all problems at once: no columns, unknown channel, missing channel, no such column (the
// file's
//            columns beside it), one column for two channels; 65: the column cannot serve, or its name stands twice

#include <map>
#include <string>
#include <vector>

#include "engine/data/recording_reader.hpp"
#include "engine/data/torque_column.hpp"

namespace torquescope {

struct Channel {
  std::string column;          // its name in the file
  std::vector<double> values;  // one per row, in the file's units
};
using Channels = std::map<std::string, Channel>;

Channels pick_channels(RawTable const& table, RecordingOptions const& options, Section const& section,
                       TorqueColumn torque = TorqueColumn::required);

std::string file_name(RawTable const& table);  // without its folder
// Requires   `column` is one of the table's names, whole
std::vector<double> const& values_of(RawTable const& table, std::string const& column);

}  // namespace torquescope
