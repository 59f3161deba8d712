#pragma once
// A packed recording of random numbers to run kernels on; one at a time is kept, since n = 1e7 fills gigabytes.
//
// Threads    one

#include <cstddef>

#include "kernels/sample_tiles.hpp"

namespace torquescope::bench {

// valid until the next call with another size
kernels::SampleTiles random_tiles(std::size_t n_samples, std::size_t n_regressors);

}  // namespace torquescope::bench
