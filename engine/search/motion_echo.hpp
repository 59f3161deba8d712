#pragma once
// Whether what a model leaves follows the motion: as any linear response to the acceleration with a memory.
//
// Statistic  energy of the mismatch in the span of the acceleration as it was 1, 2 ... 24 steps ago, beside the model;
//            a step is half a period of the filter's cut-off. Null: its replicates
// Why        noise of any spectrum is independent of the motion; a mass that swings behind the joint is not
// Threads    free function
// Source     finite impulse response: Ljung 1999, System Identification, 10.1

#include "engine/search/model_stage.hpp"

namespace torquescope {

// the share of twins whose residual follows the motion as well (twin_null.hpp)
double motion_echo_p(ModelStage const& stage);

}  // namespace torquescope
