#pragma once
// All shapes of a model's effects fitted at once: each was found alone, beside the effects before it.
//
// Search     Gauss-Newton on the model's own columns and tangents, a step halved where the squares do not fall; delay
//            and treatment of samples are found again at every trial
// Bounds     those of the effects' shapes
// Threads    pure function; deterministic
// Source     Nocedal, Wright 2006, chapter 10, doi:10.1007/978-0-387-40065-5

#include <functional>
#include <vector>

#include "engine/infer/decision/fitted_model.hpp"

namespace torquescope {

using FittedWith = std::function<FittedModel(std::vector<ShapedEffect>)>;

// the model that leaves the least squares of training rows near `from`; that one where nothing is gained
FittedModel with_fitted_shapes(FittedModel from, FittedWith const& fitted_with);

}  // namespace torquescope
