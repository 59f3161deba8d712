#pragma once
// Random numbers of a simulated recording, each with an address: (seed, recording, stream, index) names one number,
// whatever was asked before.
//
// Units      standard deviations in N m or N (torque, disturbance), rad or m (position)
// Threads    free functions; a ColouredNoise is used by one thread

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/base/options.hpp"
#include "engine/base/random_stream.hpp"

namespace torquescope {

// numbers are part of the address: never renumber
enum class NoiseStream : std::uint32_t {
  reference_phase = 0,
  torque_white = 1,
  torque_coloured = 2,
  position = 3,
  disturbance = 4,
  orthogonal = 5,
};

struct NoiseOptions {
  double torque_std = 0.0;
  double torque_coloured_std = 0.0;
  double torque_coloured_s = 0.05;
  double position_std = 0.0;
  double disturbance_std = 0.0;
  double disturbance_s = 0.0;
  double orthogonal_mse = 0.0;

  static OptionTable<NoiseOptions> const& table();
};

// `key.run` is the index of the recording, `key.domain` RandomDomain::simulation
double addressed_uniform(RandomKey const& key, NoiseStream stream, std::size_t index);  // [0, 1)
// standard normal, those from `first` on: the bits of RandomStream::normal(), several times as fast
void addressed_normals(RandomKey const& key, NoiseStream stream, std::size_t first, std::span<double> normals);

// Gaussian noise with exponential correlation, one sample after the other.
//
// Equation   x_0 = std n_0,  x_k = rho x_(k-1) + sqrt(1 - rho^2) std n_k,  rho = exp(-1 / (rate_hz correlation_s))
// White      correlation_s = 0: rho = 0
class ColouredNoise {
 public:
  ColouredNoise(RandomKey const& key, NoiseStream stream, double std, double correlation_s, double rate_hz);
  double next();
  void next(std::span<double> values);  // as many

 private:
  RandomKey key_;
  NoiseStream stream_;
  double std_, rho_, innovation_;
  double value_ = 0.0;
  std::size_t index_ = 0;
  std::array<double, 128> normals_{};  // of the indexes from the last multiple of their number on
};

}  // namespace torquescope
