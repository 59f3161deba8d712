#pragma once
// Whether the other joints of a recording load the one that is looked at: the torque of an arm's joint depends on the
// motion of all, and the model of a single joint has none of that.
//
// Library    of each other joint p beside the joint q: p'', p'^2, q'p', cosines and sines of p, q + p and q - p, and
//            p'' and q'' times cosine and sine of p: the terms of an arm of two joints, and gravity
// Measure    two columns of them, chosen on the rows outside each of ten blocks, predict the rows inside
//            (statistics/forward_columns.hpp); more would fit the noise of short recordings
// Beside     the model, and effects of the joint's own position and speed that it may lack (cubic, one turn, square and
//            root of the speed): what is their work is no load of others
// Units      relerr: share of the torque
// Threads    free function
// Source     Siciliano et al. 2009, doi:10.1007/978-1-84628-642-1, section 7.3.2 (two-link planar arm)

#include <optional>
#include <string>
#include <vector>

#include "engine/fit/statistics/held_out_gain.hpp"
#include "engine/infer/pipeline/record_pipeline.hpp"

namespace torquescope {

struct NeighbourLoad {
  HeldOutGain gain{};                  // beside the model and effects of the joint alone
  double relerr = 0.0;                 // of rows left out, with the model and the two columns
  std::vector<std::string> columns{};  // of the file: joints that the choice on all rows takes
};

// rows: of the pipeline's model, of that recording; nothing where no other joint moves or the rows are too few
std::optional<NeighbourLoad> neighbour_load(Recording const& recording, RecordPipeline const& pipeline,
                                            ProcessedRecord const& rows);

}  // namespace torquescope
