#pragma once
// The torque that acts on the joint and that the controller never tells: its level, where no missing physics can pose
// as it.
//
// Statistic  energy of the residual's second differences over rows 0.4 periods of the filter's cut-off apart: the top
//            of the band that the regression filter leaves, where effects of position, velocity and load have little to
//            say; the median over blocks of eight of these steps, because a disturbance is there all the time and an
//            impact of lost motion is not
// Limits     one level, white from tick to tick. Fit it again after an effect was accepted: what the effect left in the
//            band is counted here
// Units      N m or N
// Threads    spreads twins over the threads and processes of `workers`; same bits for any number
// Level      noise_level.hpp
// Source     LESSONS item 5 of our own prototype

#include <cstddef>

#include "engine/twin/noise_level.hpp"

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
