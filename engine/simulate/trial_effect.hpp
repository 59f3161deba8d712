#pragma once
// An effect of the catalogue whose parameters differ from lane to lane: the trials of a fit by simulation.
//
// How        lanes with the same parameters go together, each group as lane_effect() has it: of the differences of a
//            Jacobian most lanes share the parameters of any one effect
// Shapes     parameters: replicate_lanes vectors, each as Effect::runner takes them
// Bits       of a lane: the same whatever stands in the others
// Threads    as LaneEffectMaker

#include <vector>

#include "engine/simulate/lane_effect.hpp"

namespace torquescope {

LaneEffectMaker trial_effect(Effect const& effect, std::vector<std::vector<double>> const& parameters,
                             JointScales const& scales, LaneBaseline const& baseline = {});

}  // namespace torquescope
