#pragma once
// The last states of an estimator's runs in a result, /runs/<estimator>/last_state (RESULT_FORMAT.md): what a longer
// search goes on from.
//
// Shapes     one state per run, all with the same entries; without their populations, which the histories hold. A run
//            may have none
// Errors     those of ResultWriter; of ResultReader, and 65 when lists contradict one another
// Threads    as HDF5: one of the process at a time

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/fit/optim/optimiser.hpp"
#include "engine/store/result_reader.hpp"
#include "engine/store/result_writer.hpp"

namespace torquescope {

// Those of all runs until they are written, as the file has them: of millions of small runs they are most of the memory
class LastStates {
 public:
  void add(OptimiserState const& state);  // of the next run; empty: it has none
  void write(ResultWriter& writer, std::string const& label) const;

 private:
  std::size_t runs_ = 0, runs_with_one_ = 0;
  std::vector<std::string> names_{};
  std::vector<std::int64_t> sizes_{};
  std::vector<double> numbers_{};
};

// empty where no run has one
std::vector<OptimiserState> read_last_states(ResultReader const& reader, std::string const& label);

}  // namespace torquescope
