#pragma once
// Random numbers of a case: the same on every machine, whatever its standard library (SplitMix64, Marsaglia's polar
// method).
#include <cmath>
#include <cstdint>
#include <string_view>

namespace stranger {

class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_{seed} {}
  // another stream for each purpose, so that adding one does not change the others
  Chance(std::string_view case_name, std::string_view purpose) : state_{1469598103934665603ULL} {
    for (char letter : case_name) mix(letter);
    mix('/');
    for (char letter : purpose) mix(letter);
  }
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  double normal() {
    for (;;) {
      double const x = between(-1, 1);
      double const y = between(-1, 1);
      double const r = x * x + y * y;
      if (r > 0 && r < 1) return x * std::sqrt(-2 * std::log(r) / r);
    }
  }

 private:
  void mix(char letter) { state_ = (state_ ^ static_cast<unsigned char>(letter)) * 1099511628211ULL; }
  std::uint64_t state_;
};

}  // namespace stranger
