#pragma once
// Writes what a study is about into its result file: /job, /model, /data (RESULT_FORMAT.md).
//
// Errors     those of ResultWriter

#include "engine/experiment/experiment_parts.hpp"
#include "engine/store/result_writer.hpp"

namespace torquescope {

void write_study(ResultWriter& writer, Experiment const& experiment);

}  // namespace torquescope
