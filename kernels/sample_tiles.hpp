#pragma once
// Regressor and torque of 32 samples at a time (64 in float), side by side: one stream of memory instead of one per
// column.
//
// Shapes     tiles[tile][row][32]: row r < n_regressors is column r of phi, row n_regressors is tau;
//            sample = 32 * tile + place
// Numbers    double, or float: every number rounded to nearest
// Tail       places behind the last sample are zero in every row: a residual of exactly zero for finite parameters
// Blocks     2048 samples are one block, the unit of summation (residual_energy.hpp)
// Requires   tiles on a cache line (aligned_doubles.hpp) for speed; any address is correct
// Threads    Tiles are a view; read by any number of threads

#include <cstddef>

namespace torquescope::kernels {

// of one sum: a cache line; of a tile: four of them
template <class Number>
inline constexpr std::size_t lanes_of = 64 / sizeof(Number);
template <class Number>
inline constexpr std::size_t tile_samples_of = 4 * lanes_of<Number>;

inline constexpr std::size_t tile_samples = tile_samples_of<double>;
inline constexpr std::size_t block_samples = 2048;

template <class Number>
struct Tiles {
  Number const* data = nullptr;  // packed_size<Number>(n_samples, n_regressors) numbers, owned by somebody else
  std::size_t n_samples = 0;
  std::size_t n_regressors = 0;
};
using SampleTiles = Tiles<double>;
using FloatTiles = Tiles<float>;

template <class Number>
constexpr std::size_t tile_count(std::size_t n_samples) {
  return (n_samples + tile_samples_of<Number> - 1) / tile_samples_of<Number>;
}

// numbers of the packed recording
template <class Number = double>
constexpr std::size_t packed_size(std::size_t n_samples, std::size_t n_regressors) {
  return tile_count<Number>(n_samples) * tile_samples_of<Number> * (n_regressors + 1);
}

// phi: n_samples x n_regressors, column-major, columns `leading_dimension` >= n_samples doubles apart; tau: n_samples;
// writes all of tiles[0 .. packed_size) and returns a view of it; Number: double, float
template <class Number>
Tiles<Number> pack_tiles(double const* phi, std::size_t leading_dimension, double const* tau, std::size_t n_samples,
                         std::size_t n_regressors, Number* tiles);

}  // namespace torquescope::kernels
