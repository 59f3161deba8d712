#pragma once
// How much a row counts where replicates, each with a sticking law of its own, differ from one another.
//
// Equation   share_k = min(1, sqrt(s^2 / variance_k)); variance_k: over replicates, of torque - columns * parameters at
//            the parameters that they were made with, whitened along the rows (row_whitening.hpp), pooled over the rows
//            that the filter couples most; s^2: its median over the rows that a mask keeps
// Why        parameters fitted to each replicate would carry its sticking law to every other row
// Rows       all but rests. A row that fewer than half of the replicates keep counts for nothing
// Result     as `rows` alone where replicates diverge
// Threads    spreads replicates over the threads and processes of `workers`; same bits for any number
// Source     Aitken 1935; weights by replication: Carroll, Ruppert 1988, Transformation and Weighting in Regression

#include "engine/infer/replicates/baseline_twin.hpp"
#include "engine/infer/replicates/twin_exchange.hpp"

namespace torquescope {

// made: whose replicates draw sticking laws; rows: of the noise; pipeline: of the model of `made`, weighs nothing and
// masks; then it weighs by the result
NoiseWeights reversal_weights(BaselineTwin const& made, RecordPipeline& pipeline, RowWhitening const& rows,
                              TwinAddress const& address, std::size_t twins, TwinWorkers const& workers);

}  // namespace torquescope
