#pragma once
// Random numbers of a set, addressed by (seed, purpose, number): the same bits on every machine.
//
// Source     SplitMix64: Steele, Lea, Flood 2014, doi:10.1145/2660193.2660195

#include <cstdint>

namespace servo {

enum class Purpose : std::uint64_t { base = 1, law_numbers, motion, clock };

class Chance {
 public:
  Chance(std::uint64_t seed, Purpose purpose, std::uint64_t number) : state_{seed} {
    state_ = word() ^ static_cast<std::uint64_t>(purpose);
    state_ = word() ^ number;
  }
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(word() >> 11U) * 0x1.0p-53);
  }
  double sign() { return between(0.0, 1.0) < 0.5 ? -1.0 : 1.0; }

 private:
  std::uint64_t word() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t mixed = state_;
    mixed = (mixed ^ (mixed >> 30U)) * 0xBF58476D1CE4E5B9U;
    mixed = (mixed ^ (mixed >> 27U)) * 0x94D049BB133111EBU;
    return mixed ^ (mixed >> 31U);
  }

  std::uint64_t state_;
};

}  // namespace servo
