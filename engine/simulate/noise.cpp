#include "engine/simulate/noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/contract.hpp"
#include "engine/base/portable_math.hpp"
#include "kernels/normal_quantiles.hpp"
#include "kernels/philox.hpp"

namespace torquescope {

OptionTable<NoiseOptions> const& NoiseOptions::table() {
  constexpr double unlimited = std::numeric_limits<double>::max();
  using O = NoiseOptions;
  static OptionTable<NoiseOptions> const options(
      "simulate.noise", "random parts of a simulated recording",
      {{"torque_std", &O::torque_std, "N m or N", 0.0, unlimited, "white noise of the measured torque"},
       {"torque_coloured_std", &O::torque_coloured_std, "N m or N", 0.0, unlimited,
        "correlated noise of the measured torque, in addition"},
       {"torque_coloured_s", &O::torque_coloured_s, "s", 0.0, unlimited, "its correlation time"},
       {"position_std", &O::position_std, "rad or m", 0.0, unlimited,
        "white noise of the position before the encoder rounds it"},
       {"disturbance_std", &O::disturbance_std, "N m or N", 0.0, unlimited,
        "torque that acts on the joint and that nobody measures"},
       {"disturbance_s", &O::disturbance_s, "s", 0.0, unlimited, "its correlation time; 0: white from tick to tick"},
       {"orthogonal_mse", &O::orthogonal_mse, "(N m)^2 or N^2", 0.0, unlimited,
        "inverse_dynamics: noise without any part that the model could fit; least squares gives exactly the plant's "
        "parameters and this mean squared error"}});
  return options;
}

double addressed_uniform(RandomKey const& key, NoiseStream stream, std::size_t index) {
  TORQUESCOPE_EXPECT(index <= std::numeric_limits<std::uint32_t>::max());
  return RandomStream(key, static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(index)).uniform();
}

void addressed_normals(RandomKey const& key, NoiseStream stream, std::size_t first, std::span<double> normals) {
  constexpr std::size_t together = 128, words = 4;
  std::array<std::uint32_t, together * words> blocks;
  std::array<double, together> probabilities;
  for (std::size_t done = 0; done < normals.size(); done += together) {
    std::size_t const count = std::min(together, normals.size() - done);
    TORQUESCOPE_EXPECT(first + done + count - 1 <= std::numeric_limits<std::uint32_t>::max());
    auto const counter =
        RandomStream::first_counter(key, static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(first + done));
    auto const philox_key = RandomStream::philox_key(key);
    kernels::philox_blocks({{philox_key[0], philox_key[1]}, counter[1], counter[2], counter[3]}, count, 0, 1,
                           blocks.data());
    for (std::size_t i = 0; i < count; ++i)
      probabilities[i] = RandomStream::probability(std::uint64_t{blocks[words * i + 1]} << 32 | blocks[words * i]);
    kernels::normal_quantiles(probabilities.data(), count, normals.data() + done);
  }
}

ColouredNoise::ColouredNoise(RandomKey const& key, NoiseStream stream, double std, double correlation_s, double rate_hz)
    : key_(key),
      stream_(stream),
      std_(std),
      rho_(correlation_s > 0.0 ? portable_exp(-1.0 / (rate_hz * correlation_s)) : 0.0),
      innovation_(std::sqrt((1.0 - rho_) * (1.0 + rho_))) {
  TORQUESCOPE_EXPECT(std >= 0.0 && correlation_s >= 0.0 && rate_hz > 0.0);
}

double ColouredNoise::next() {
  if (std_ == 0.0) return 0.0;
  std::size_t const place = index_ % normals_.size();
  if (place == 0) addressed_normals(key_, stream_, index_, normals_);
  double const fresh = std_ * normals_[place];
  value_ = index_ == 0 ? fresh : rho_ * value_ + innovation_ * fresh;
  ++index_;
  return value_;
}

void ColouredNoise::next(std::span<double> values) {
  if (std_ == 0.0) return std::fill(values.begin(), values.end(), 0.0);
  for (double& value : values) value = next();
}

}  // namespace torquescope
