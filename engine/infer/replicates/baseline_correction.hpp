#pragma once
// The baseline's parameters without the bias of differentiation, encoder, filter and loop: those whose replicates give
// on average the fit that the recording gives.
//
// Equation   a <- a + g (fit(recording) - mean fit(replicate(a))), g = 1 in the first two rounds, then 1/2, 1/3 ...
// Stop       where the torque of the difference is below 0.2 of what fits of single replicates scatter (root mean
//            squares), where it no longer falls (the best round is kept), or after 6 rounds. Columns that are nearly
//            one share their torque as they like: parameter by parameter such a fit never agrees
// Replicates the same noise in every round, so that rounds differ by a alone
// Errors     Error 65 as make_twin_joint and the pipeline
// Threads    spreads replicates over the threads and processes of `workers`; same bits for any number
// Source     Gourieroux, Monfort, Renault 1993, doi:10.1002/jae.3950080507; gains: Robbins, Monro 1951

#include <Eigen/Core>
#include <cstddef>

#include "engine/infer/pipeline/record_pipeline.hpp"
#include "engine/infer/replicates/twin_exchange.hpp"
#include "engine/simulate/clean_twin.hpp"

namespace torquescope {

struct BaselineCorrection {
  Eigen::VectorXd parameters;     // corrected
  Eigen::VectorXd least_squares;  // of the recording; effects may be negative where fits are free (joint_fit.hpp)
  Eigen::VectorXd std;            // of a fit, over twins: noise of this recording's length
  double mismatch = 0.0;  // of the round that is kept: torque of the difference over that of a replicate's scatter
  int rounds = 0;
  bool converged = false;
  bool ran_away = false;  // the loop could not hold the joint: the recording's loop is not what was identified
};

// recording: as the pipeline processed it; start: where the search begins; twins >= 8
BaselineCorrection correct_baseline(ProcessedRecord const& recording, Eigen::VectorXd const& start,
                                    TwinLoop const& loop, TwinTrack const& track, RecordPipeline const& pipeline,
                                    double step_s, TwinAddress const& address, std::size_t twins,
                                    TwinWorkers const& workers);

}  // namespace torquescope
