#pragma once
// The noise of a recording's rows, as its replicates show it, made into weights of rows.
//
// Noise      residuals of replicates less their mean, on rows that all of them keep, without the friction random walk,
//            which is no stationary noise. Walk: at the level the baseline found, its doubt included
// Result     equal weights where replicates do not differ or diverge
// Threads    spreads replicates over the threads and processes of `workers`; same bits for any number
// Source     METHOD.md, Weights of rows

#include <cstddef>
#include <memory>

#include "engine/infer/replicates/baseline_twin.hpp"
#include "engine/infer/replicates/twin_exchange.hpp"

namespace torquescope {

// pipeline: weighs nothing yet, keeps each twin's own rows
RowWhitening twin_whitening(CleanTwin const& twin, RecordPipeline const& pipeline, TwinAddress const& address,
                            std::size_t twins, TwinWorkers const& workers);

// weights: those of `made`, without wander
NoiseWeights with_wander_of(BaselineTwin const& made, NoiseWeights const& weights, RecordPipeline const& pipeline);

}  // namespace torquescope
