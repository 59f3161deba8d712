#pragma once
// Recordings that a program has in memory, under the names by which its job asks for them in place of files.
//
// Units      those of the columns, as in a file: the job's recording section says what they are
// Identity   the sha256 is that of names and numbers: equal arrays are the same recording
// Threads    plain records; free function

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/data/recording_reader.hpp"

namespace torquescope {

using RecordedTables = std::map<std::string, RawTable>;
using NamedColumns = std::vector<std::pair<std::string, std::vector<double>>>;

// what read_table() would make of a file of these columns. A column of another length than most cannot be used, and
// says so where it is asked for. Errors: 65, no column, or more numbers than a recording may hold
RawTable table_in_memory(std::string name, NamedColumns columns);

}  // namespace torquescope
