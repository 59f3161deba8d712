#include "kernels/sample_tiles.hpp"

#include <algorithm>
#include <cassert>

namespace torquescope::kernels {

template <class Number>
Tiles<Number> pack_tiles(double const* phi, std::size_t leading_dimension, double const* tau, std::size_t n_samples,
                         std::size_t n_regressors, Number* tiles) {
  assert(n_regressors == 0 || leading_dimension >= n_samples);
  constexpr std::size_t in_tile = tile_samples_of<Number>;
  Number* row = tiles;
  for (std::size_t first = 0; first < n_samples; first += in_tile) {
    std::size_t const count = std::min(in_tile, n_samples - first);
    for (std::size_t r = 0; r <= n_regressors; ++r, row += in_tile) {
      double const* const column = (r < n_regressors ? phi + r * leading_dimension : tau) + first;
      std::transform(column, column + count, row, [](double x) { return static_cast<Number>(x); });
      std::fill(row + count, row + in_tile, Number{0});
    }
  }
  return {tiles, n_samples, n_regressors};
}

template SampleTiles pack_tiles(double const*, std::size_t, double const*, std::size_t, std::size_t, double*);
template FloatTiles pack_tiles(double const*, std::size_t, double const*, std::size_t, std::size_t, float*);

}  // namespace torquescope::kernels
