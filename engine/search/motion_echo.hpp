#pragma once
// Whether what a model leaves follows the motion: as any linear answer to the acceleration that has a memory.
//
// Statistic  energy of the mismatch in the span of the acceleration as it was 1, 2 ... 24 steps ago, beside the model;
//            a step is half a period of the filter's cut-off
// Why        noise of whatever colour knows nothing of the motion; a mass that swings behind the joint does
// Threads    free function
// Source     finite impulse response (Ljung 1999, System Identification, 10.1); its null as everywhere: the twins

#include "engine/search/model_stage.hpp"

namespace torquescope {

// the share of twins whose residual follows the motion as well (twin_null.hpp)
double motion_echo_p(ModelStage const& stage);

}  // namespace torquescope
