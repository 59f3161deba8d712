#pragma once
// Random signals, one number per tick, each from its own stream of the case's seed.
//
// Numbers    std::mt19937_64 (defined to the bit by the standard), Box-Muller for normal ones
// Threads    one object, one thread

#include <cstdint>
#include <random>
#include <string>

namespace concealed {

class Random {
 public:
  // `purpose` separates streams of one seed: "current", "disturbance", ...
  Random(std::uint64_t seed, std::string const& purpose);
  double uniform();  // in (0, 1)
  double between(double low, double high) { return low + (high - low) * uniform(); }
  double normal();
  std::size_t index(std::size_t n);  // 0 ... n-1

 private:
  std::mt19937_64 bits_;
};

// Ornstein-Uhlenbeck: normal, standard deviation `std`, correlation exp(-t / memory_s); sampled exactly
class ColouredNoise {
 public:
  ColouredNoise(Random random, double std, double memory_s, double tick_s);
  double next();

 private:
  Random random_;
  double std_, keep_, value_;
};

}  // namespace concealed
