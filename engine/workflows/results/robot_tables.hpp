#pragma once
// An arm in a result: /robot has frames, limits, drives and, where its file gave them, inertias (RESULT_FORMAT.md), so
// that an export needs no file beside the result.
//
// Units      SI; an infinite limit is none
// Errors     those of ResultWriter; Error 65 when tables of a result do not fit each other
// Threads    as ResultReader and ResultWriter

#include "engine/robot/serial_chain.hpp"
#include "engine/store/result_reader.hpp"
#include "engine/store/result_writer.hpp"

namespace torquescope {

void write_robot_tables(ResultWriter& writer, SerialChain const& chain);

struct StoredRobot {
  SerialChain chain{};
  bool has_limits = true;  // no: a result of a version that kept frames alone
};
StoredRobot read_robot_tables(ResultReader const& reader);

}  // namespace torquescope
