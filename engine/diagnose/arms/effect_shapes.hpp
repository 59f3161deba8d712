#pragma once
// The shapes of an arm's effects (HeldEffect) at which its training rows are explained best, as the diagnosis finds
// them.
//
// Method     variable projection: the linear parameters of the whole arm are solved for every shape that is tried; the
//            grid of the diagnosis (shape_grid.hpp), then steps of Levenberg and Marquardt from its best point.
//            An effect whose shape is given begins there. Several effects in turn
// Signs      a parameter that cannot be negative: a shape at which it would be explains nothing
// Weights    rows are divided by the noise of their joint without the effects
// Errors     those of the filters
// Threads    free functions
// Source     Golub, Pereyra 1973, doi:10.1137/0710036

#include <span>
#include <string>
#include <vector>

#include "engine/diagnose/arms/arm_fit.hpp"

namespace torquescope {

// the model's effects with shapes, scales and baselines
std::vector<HeldEffect> refined_effects(ArmModel const& model, std::span<RecordedArm const> train,
                                        ArmFilter const& filter);

// "stribeck_speed_2" of the first shape of an effect of joint 2
std::string shape_name(HeldEffect const& held, std::size_t shape);
// shapes that are no more than the end of what is plausible
std::vector<std::size_t> shapes_at_bounds(HeldEffect const& held);

}  // namespace torquescope
