#pragma once
// The level of the torque that acts on the joint and that the controller regression cannot see.
//
// Statistic  median over blocks of the energy of the residual's second differences over rows 0.4 periods of the cut-off
//            apart: the top of the band, where position, velocity and load say little; the median spares impacts
// Limits     one level, white from tick to tick. Fit it again after an effect was accepted
// Units      N m or N
// Threads    spreads replicates over the threads and processes of `workers`; same bits for any number
// Source     METHOD.md, Replicates; level: noise_level.hpp

#include <cstddef>

#include "engine/infer/replicates/noise_level.hpp"

namespace torquescope {

// kept samples that are 0.4 periods of the cut-off apart: rows closer than the filter's memory only say how smooth it
// is
std::size_t fast_lag(RecordPipeline const& pipeline);

// median over blocks of the mean squared second difference of the residual, over rows with both neighbours
double fast_energy(ProcessedRecord const& record, RecordPipeline const& pipeline);

// the twin's own disturbance is not used; the loop's torque noise sets the scale of the first guess
NoiseLevel disturbance_level(ProcessedRecord const& recording, CleanTwin const& twin, RecordPipeline const& pipeline,
                             TwinAddress const& address, std::size_t twins, TwinWorkers const& workers);

}  // namespace torquescope
