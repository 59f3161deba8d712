#pragma once
// Regressor and torque of 32 samples at a time, side by side: one stream of memory instead of one per column.
//
// Shapes     tiles[tile][row][32]: row r < n_regressors is column r of phi, row n_regressors is tau;
//            sample = 32 * tile + place
// Tail       places behind the last sample are zero in every row: a residual of exactly zero for finite parameters
// Blocks     64 tiles (2048 samples) are one block, the unit of summation (residual_energy.hpp)
// Requires   tiles on a cache line (aligned_doubles.hpp) for speed; any address is correct
// Threads    a SampleTiles is a view; read by any number of threads

#include <cstddef>

namespace torquescope::kernels {

inline constexpr std::size_t tile_samples = 32;
inline constexpr std::size_t block_samples = 2048;

struct SampleTiles {
  double const* data = nullptr;  // packed_size(n_samples, n_regressors) doubles, owned by somebody else
  std::size_t n_samples = 0;
  std::size_t n_regressors = 0;
};

// doubles of the packed recording
std::size_t packed_size(std::size_t n_samples, std::size_t n_regressors);

// phi: n_samples x n_regressors, column-major, columns `leading_dimension` >= n_samples doubles apart; tau: n_samples;
// writes all of tiles[0 .. packed_size) and returns a view of it
SampleTiles pack_tiles(double const* phi, std::size_t leading_dimension, double const* tau, std::size_t n_samples,
                       std::size_t n_regressors, double* tiles);

}  // namespace torquescope::kernels
