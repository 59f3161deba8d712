#include "kernels/sample_tiles.hpp"

#include <algorithm>
#include <cassert>

namespace torquescope::kernels {

std::size_t packed_size(std::size_t n_samples, std::size_t n_regressors) {
  std::size_t const n_tiles = (n_samples + tile_samples - 1) / tile_samples;
  return n_tiles * tile_samples * (n_regressors + 1);
}

SampleTiles pack_tiles(double const* phi, std::size_t leading_dimension, double const* tau, std::size_t n_samples,
                       std::size_t n_regressors, double* tiles) {
  assert(n_regressors == 0 || leading_dimension >= n_samples);
  double* row = tiles;
  for (std::size_t first = 0; first < n_samples; first += tile_samples) {
    std::size_t const count = std::min(tile_samples, n_samples - first);
    for (std::size_t r = 0; r <= n_regressors; ++r, row += tile_samples) {
      double const* const column = r < n_regressors ? phi + r * leading_dimension : tau;
      double* const tail = std::copy_n(column + first, count, row);
      std::fill(tail, row + tile_samples, 0.0);
    }
  }
  return {tiles, n_samples, n_regressors};
}

}  // namespace torquescope::kernels
