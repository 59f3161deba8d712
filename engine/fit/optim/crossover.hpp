#pragma once
// Binomial crossover: each parameter comes from the mutant with probability CR, one of them always.
//
// Equation   u_j = v_j if b_j < CR or j = j_rand, else x_j; b_j in [0, 1)                   (seed eq. 6)
//            b_j < CR instead of the printed <=, so that CR = 0 takes j_rand only and CR = 1 takes every v_j
// Random     1 draw for j_rand, then one per parameter

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/base/random_stream.hpp"

namespace torquescope {

// first ? a : b without a branch, which nobody could predict
inline double chosen(bool first, double a, double b) {
  std::uint64_t const mask = -std::uint64_t{first};
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(a) & mask) | (std::bit_cast<std::uint64_t>(b) & ~mask));
}

// turns the mutant into the trial vector in place
inline void cross_binomial(RandomStream& random, double CR, std::span<double const> target, std::span<double> mutant) {
  TORQUESCOPE_EXPECT(target.size() == mutant.size() && !target.empty());
  std::size_t const j_rand = random.below(static_cast<std::uint32_t>(mutant.size()));
  double const always = mutant[j_rand];
  // drawn for j_rand too: draw j belongs to parameter j
  for (std::size_t j = 0; j < mutant.size(); ++j) mutant[j] = chosen(random.uniform() < CR, mutant[j], target[j]);
  mutant[j_rand] = always;
}

}  // namespace torquescope
