#pragma once
// Whether a recorded torque is a function of the position alone, as a controller computes it to hold a weight.
//
// Why        a joint that moves has an inertia and friction; a torque without either did not move it
// Rule       the model's terms of position and constants explain the torque but for what friction may be, and its
//            terms of velocity and acceleration do not make it predict rows clearly better that it was not fitted to
//            (held_out_gain.hpp: blocks, paired, one-sided, level 5 %)
// Asked      of recordings whose motion goes both ways at several speeds: elsewhere friction may be one with the offset
// Threads    pure function
// Source     Diebold, Mariano 1995, doi:10.1080/07350015.1995.10524599

#include <optional>

#include "engine/infer/pipeline/motion_limits.hpp"
#include "engine/infer/pipeline/record_pipeline.hpp"
#include "engine/infer/pipeline/recording_checks.hpp"

namespace torquescope {

// record: of the model without effects, not whitened
std::optional<Hopeless> check_static_torque(ProcessedRecord const& record, RecordPipeline const& pipeline,
                                            MotionLimits const& limits);

}  // namespace torquescope
