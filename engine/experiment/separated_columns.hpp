#pragma once
// What [excite] separate names, as columns of the rows that a motion is judged by.
//
// Names      a parameter of the model: "xxr2", "viscous_3"; an effect at a joint: "stribeck@3". Of an effect that the
//            model has, its parameters; of any other one, columns beside the model's, at a shape in the middle of its
//            bounds (in the logarithm where it is searched so), with the joint's limits as scales
// Errors     Problems (78): no such name, an effect with memory or of a fitted model or of a channel, twice the same
// Threads    free function; the rows may be made from any number of threads
// Source     shape bounds: effects/effect.hpp

#include <vector>

#include "engine/fit/excite/excite_options.hpp"
#include "engine/fit/excite/motion_quality.hpp"
#include "engine/fit/problem/arm_model.hpp"

namespace torquescope {

// rows: those of the model
RowModel with_separated(RowModel rows, ArmModel const& model, ExciteOptions const& options, Section const& section,
                        std::vector<Problem>& problems);

// motion of every joint at the samples
std::vector<Motion> joint_motions(MotionSamples const& samples);

}  // namespace torquescope
