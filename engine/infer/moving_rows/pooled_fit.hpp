#pragma once
// One fit of a model to all of its training recordings, as a step from the fit of the first.
//
// Equation   theta = theta_1 + [X_1; X_2; ...]^+ [e_1; e_2; ...], e_i what theta_1 leaves of recording i less the
//            replicates' mean; rows weighed by their noise, own nuisances taken out. theta_1 has the bias of processing
//            taken out, and so has the sum
// Replicates each by the same step from its own fit of the first: deviations from their mean, shapes free
// None       without further recordings; or where the fit of the first is at a bound, which holds one of its parameters
// Threads    free function
// Source     engine/infer/moving_rows/THEORY.md, Rows and replicates

#include <optional>

#include "engine/infer/moving_rows/training_rows.hpp"

namespace torquescope {

std::optional<PooledFit> pooled_fit(ModelStage const& stage, TrainingRows const& training);

}  // namespace torquescope
