#pragma once
// Binomial crossover: each parameter comes from the mutant with probability CR, one of them always.
//
// Equation   u_j = v_j if b_j < CR or j = j_rand, else x_j; b_j in [0, 1)                   (seed eq. 6)
//            b_j < CR instead of the printed <=, so that CR = 0 takes j_rand only and CR = 1 takes every v_j
// Random     1 draw for j_rand, then one per parameter

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/base/random_stream.hpp"

namespace torquescope {

// turns the mutant into the trial vector in place
inline void cross_binomial(RandomStream& random, double CR, std::span<double const> target, std::span<double> mutant) {
  TORQUESCOPE_EXPECT(target.size() == mutant.size() && !target.empty());
  std::size_t const j_rand = random.below(static_cast<std::uint32_t>(mutant.size()));
  for (std::size_t j = 0; j < mutant.size(); ++j) {
    // drawn for j_rand too: draw j belongs to parameter j; no branch, for nobody can predict it
    bool const from_mutant = (random.uniform() < CR) | (j == j_rand);
    double const parameters[] = {target[j], mutant[j]};
    mutant[j] = parameters[from_mutant];
  }
}

}  // namespace torquescope
