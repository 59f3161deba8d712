#include "kernels/sample_tiles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace torquescope::kernels {
namespace sample_tiles_test {

TEST(SampleTiles, HoldEverySampleOnceAndZeroBehindTheLast) {
  for (std::size_t n : {1, 31, 32, 33, 64, 100}) {
    for (std::size_t n_regressors : {0, 1, 3}) {
      std::size_t const stride = n + 2;
      std::vector<double> phi(stride * n_regressors), tau(n);
      for (std::size_t i = 0; i < phi.size(); ++i) phi[i] = 1.0 + static_cast<double>(i);
      for (std::size_t i = 0; i < n; ++i) tau[i] = -1.0 - static_cast<double>(i);
      std::vector<double> tiles(packed_size(n, n_regressors), std::numeric_limits<double>::quiet_NaN());

      pack_tiles(phi.data(), stride, tau.data(), n, n_regressors, tiles.data());

      for (std::size_t i = 0; i < tiles.size(); ++i) {
        std::size_t const place = i % tile_samples;
        std::size_t const row = i / tile_samples % (n_regressors + 1);
        std::size_t const sample = i / (tile_samples * (n_regressors + 1)) * tile_samples + place;
        double const expected = sample >= n ? 0.0 : row < n_regressors ? phi[row * stride + sample] : tau[sample];
        ASSERT_EQ(tiles[i], expected) << "n = " << n << ", row " << row << ", sample " << sample;
      }
    }
  }
}

TEST(SampleTiles, NeedNothingForNoSamples) {
  EXPECT_EQ(packed_size(0, 7), 0u);
  auto const tiles = pack_tiles<double>(nullptr, 0, nullptr, 0, 7, nullptr);
  EXPECT_EQ(tiles.n_samples, 0u);
  EXPECT_EQ(tiles.n_regressors, 7u);
}

TEST(SampleTiles, AreWholeTiles) {
  EXPECT_EQ(packed_size(1, 4), 5u * 32u);
  EXPECT_EQ(packed_size(32, 4), 5u * 32u);
  EXPECT_EQ(packed_size(33, 4), 2u * 5u * 32u);
}

}  // namespace sample_tiles_test
}  // namespace torquescope::kernels
