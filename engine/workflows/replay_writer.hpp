#pragma once
// Writes a replay into a result file: /replay (store/RESULT_FORMAT.md).
//
// Errors     those of ResultWriter

#include "engine/simulate/rollout/replay.hpp"
#include "engine/store/result_writer.hpp"

namespace torquescope {

void write_replay(ResultWriter& writer, Replay const& replay);

}  // namespace torquescope
