#include "bench/kernels/random_tiles.hpp"

#include <array>
#include <random>

#include "kernels/aligned_doubles.hpp"

namespace torquescope::bench {
namespace {

// numbers repeat every 4096: filling gigabytes is not what we measure
void fill(kernels::AlignedDoubles& numbers) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::array<double, 4096> source;
  for (double& number : source) number = uniform(random);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = source[i * 7 % source.size()];
}

}  // namespace

kernels::SampleTiles random_tiles(std::size_t n_samples, std::size_t n_regressors) {
  static kernels::AlignedDoubles packed;
  static std::size_t kept_samples = 0, kept_regressors = 0;
  if (n_samples != kept_samples || n_regressors != kept_regressors) {
    packed = {};
    packed.resize(kernels::packed_size(n_samples, n_regressors));
    fill(packed);
    kept_samples = n_samples;
    kept_regressors = n_regressors;
  }
  return {packed.data(), n_samples, n_regressors};
}

}  // namespace torquescope::bench
