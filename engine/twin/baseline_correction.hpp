#pragma once
// The baseline's parameters without the bias of differentiation, encoder, filter and loop: those whose twins, sent
// through the same pipeline, give on average what the recording gives.
//
// Equation   find a with mean over twins of fit(twin(a)) = fit(recording):  a <- a + g (fit(recording) - mean
//            fit(twin(a))), g = 1 in the first two rounds, then 1/2, 1/3 ... (Robbins, Monro)
// Stop       every |fit(recording) - mean fit(twin(a))| below 0.2 of the standard deviation of that parameter over
//            twins, or 6 rounds
// Twins      the same noise in every round, so that rounds differ by a alone
// Errors     Error 65 as make_twin_joint and the pipeline
// Threads    spreads twins over the threads and processes of `workers`; same bits for any number
// Source     Gourieroux, Monfort, Renault 1993, Indirect inference; LESSONS item 8 of our own prototype

#include <Eigen/Core>
#include <cstddef>

#include "engine/pipeline/record_pipeline.hpp"
#include "engine/simulate/clean_twin.hpp"
#include "engine/twin/twin_exchange.hpp"

namespace torquescope {

struct BaselineCorrection {
  Eigen::VectorXd parameters;     // corrected
  Eigen::VectorXd least_squares;  // of the recording; effects may be negative where fits are free (joint_fit.hpp)
  Eigen::VectorXd std;            // of a fit, over twins: noise of this recording's length
  double largest_mismatch = 0.0;  // of the last round, in std
  int rounds = 0;
  bool converged = false;
  bool ran_away = false;  // the loop could not hold the joint: the recording's loop is not what was identified
};

// recording_fit: what the pipeline gives for the recording; start: where the search begins; twins >= 8
BaselineCorrection correct_baseline(Eigen::VectorXd const& recording_fit, Eigen::VectorXd const& start,
                                    TwinLoop const& loop, TwinTrack const& track, RecordPipeline const& pipeline,
                                    double step_s, TwinAddress const& address, std::size_t twins,
                                    TwinWorkers const& workers);

}  // namespace torquescope
