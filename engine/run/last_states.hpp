#pragma once
// The last states of an estimator's runs in a result, /runs/<estimator>/last_state (RESULT_FORMAT.md): what a longer
// search goes on from.
//
// Shapes     one state per run, all with the same entries; without their populations, which the histories hold. A run
//            may have none
// Errors     those of ResultWriter; of ResultReader, and 65 when lists contradict one another
// Threads    as HDF5: one of the process at a time

#include <string>
#include <vector>

#include "engine/optim/optimiser.hpp"
#include "engine/store/result_reader.hpp"
#include "engine/store/result_writer.hpp"

namespace torquescope {

void write_last_states(ResultWriter& writer, std::string const& label, std::vector<OptimiserState> const& states);

// empty where no run has one
std::vector<OptimiserState> read_last_states(ResultReader const& reader, std::string const& label);

}  // namespace torquescope
