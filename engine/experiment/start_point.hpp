#pragma once
// Where the searches of an estimator with `start_from` begin: at the best estimate of a result, the run with the least
// MSE whichever method found it, parameter by parameter of the same name.
//
// Errors     78 where the result has no parameter of this model, or one in another unit, or no runs; 65, 66, 74 of
//            ResultReader
// Threads    as HDF5: one of the process at a time

#include "engine/experiment/experiment_parts.hpp"

namespace torquescope {

// reads the results, sets `start` of the plans and makes their optimisers begin there; parameters and box are known
void set_starts(Experiment::Parts& parts);

}  // namespace torquescope
