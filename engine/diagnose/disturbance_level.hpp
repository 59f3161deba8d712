#pragma once
// The torque that acts on the joint and that the controller never tells: its level, where no missing physics can pose as it.
//
// Statistic  energy of the residual's second differences over neighbouring rows: the top of the band that the regression
//            filter leaves, where effects of position, velocity and load have little to say; the median over blocks of
//            eight rows, because a disturbance is there all the time and an impact of lost motion is not
// Equation   energy(twins with level s) = energy(recording); energy grows linearly with s^2, found by secant
// Zero       when the recording's energy is within 1.64 standard deviations of twins without disturbance: a level too
//            low makes false names, so the doubt goes to the disturbance (one-sided 5 %)
// Limits     one level, white from tick to tick. Fit it again after an effect was accepted: what the effect left in the
//            band is counted here
// Units      N m or N
// Threads    spreads twins over `threads`; same bits for any number
// Source     LESSONS item 5 of our own prototype

#include <cstddef>

#include "engine/diagnose/record_pipeline.hpp"
#include "engine/simulate/clean_twin.hpp"

namespace torquescope {

struct DisturbanceLevel {
  double std = 0.0;
  double variance_error = 0.0;  // standard error of std^2, from the spread of the energy over twins at this level
  double energy_ratio = 0.0;    // recording over twins without disturbance
  double z = 0.0;               // of the recording's energy among them
  bool ran_away = false;
};

// median over blocks of the mean squared second difference of the residual, over rows with both neighbours
double fast_energy(ProcessedRecord const& record);

// the twin's own disturbance is not used; the loop's torque noise sets the scale of the first guess
DisturbanceLevel disturbance_level(ProcessedRecord const& recording, CleanTwin const& twin,
                                   RecordPipeline const& pipeline, double step_s, TwinAddress const& address,
                                   std::size_t twins, int threads);

}  // namespace torquescope
