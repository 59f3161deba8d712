#pragma once
// Which positions and speeds a recording has shown a model: beyond them a law that was fitted there is a guess.
//
// Margin     a twentieth of each range, either side
// Rows       of the fit, with their own samples of the motion
// Units      SI
// Threads    free functions

#include <Eigen/Core>
#include <vector>

#include "engine/pipeline/record_pipeline.hpp"

namespace torquescope {

struct MotionRange {
  double least_position = 0.0, most_position = 0.0, least_velocity = 0.0, most_velocity = 0.0;
};

MotionRange range_of(ProcessedRecord const& record, RecordPipeline const& pipeline);

// those of the record's kept rows that are within it and its margin
std::vector<Eigen::Index> rows_within(MotionRange const& range, ProcessedRecord const& record,
                                      RecordPipeline const& pipeline);

}  // namespace torquescope
