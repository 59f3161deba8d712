#pragma once
// Estimators that simulate the recordings: the fit of one, errors of all, and what the result file says of them.
//
// Metrics    of a table are of the torque over all samples of every recording, in closed loop; of the position where
//            the torque does not count
// Threads    spreads rollouts over `threads`

#include "engine/experiment/experiment_parts.hpp"
#include "engine/experiment/runs/run_summary.hpp"
#include "engine/simulate/rollout/rollout_fit.hpp"
#include "engine/store/result_writer.hpp"

namespace torquescope {

RolloutFit fit_by_rollouts(Experiment::Parts const& parts, LmOptions const& options, int threads,
                           StopAsked const& stop);

// fills train and validate of results
void measure_rollouts(Experiment::Parts const& parts, int threads, RunResults& results);

// standard errors, intervals, sums and effective samples of each channel
// of which channel, in which unit
std::string rollout_error_unit(Experiment::Parts const& parts);
void write_rollout_errors(ResultWriter& writer, std::string const& label, Experiment::Parts const& parts);
void write_rollout_fit(ResultWriter& writer, std::string const& label, RolloutFit const& fit);

}  // namespace torquescope
