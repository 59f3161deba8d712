#pragma once
// How strong a noise must be in the replicates so that one statistic of theirs is what the recording has.
//
// Equation   mean of statistic(replicates with variance s^2) = statistic(recording), by the secant method in s^2; never
//            beyond the most that is plausible
// Zero       when the recording's statistic is less than `least_z` standard deviations above that of replicates without
//            the noise. A level too low makes false names (1.64: one-sided 5 %)
// Error      with least_z below 0 also a level of 0 has its error: replicates then draw about 0
// Threads    spreads replicates over the threads and processes of `workers`; same bits for any number
// Source     METHOD.md, Replicates

#include <cstddef>
#include <functional>
#include <limits>

#include "engine/infer/pipeline/record_pipeline.hpp"
#include "engine/infer/replicates/twin_batch.hpp"

namespace torquescope {

struct NoiseLevel {
  double std = 0.0;
  // standard error of std^2, from the spread of the statistic over twins at this level; 0 at most_std
  double variance_error = 0.0;
  double ratio = 0.0;  // statistic of the recording over that of twins without the noise
  double z = 0.0;      // of the recording's among them
  bool ran_away = false;
};

struct NoiseQuestion {
  std::function<double(ProcessedRecord const&)> statistic;                     // from any thread
  std::function<void(TwinLoop& loop, double std, double variance_error)> put;  // the noise into a loop
  std::function<double(double recording, double twins)> first_guess;           // of the variance, from both statistics
  double least_z = 1.64;
  double most_std = std::numeric_limits<double>::infinity();
};

// twins >= 8; the noise that `twin` has already is not used
NoiseLevel noise_level(NoiseQuestion const& question, ProcessedRecord const& recording, CleanTwin const& twin,
                       RecordPipeline const& pipeline, TwinAddress const& address, std::size_t twins,
                       TwinWorkers const& workers);

}  // namespace torquescope
